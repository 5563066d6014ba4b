// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "pago/simulator/simulator.hpp"
#include "sensor.hpp"
#include "status_cycle.hpp"

namespace pago::simulator {

/// Puts firings into datagrams as the unit does.
class PacketStream {
 public:
  struct Settings {
    PacketStamp stamp = PacketStamp::kFirstFiring;
    std::int64_t start_ns = 0;  ///< sensor time of the first firing
    std::uint64_t count = 0;    ///< of packets
    std::uint64_t seed = 0;
  };
  /// All must outlive it.
  PacketStream(Sensor& sensor, RayCaster& scene, Traffic& traffic, StatusCycle status, Settings settings);

  bool next(SimulatedPacket& packet);
  /// Goes on with this packet or one that is at most a few before it. Nothing between is cast.
  void skip_to(std::uint64_t packet) noexcept;

 private:
  void write_block(SimulatedPacket& packet,
                   std::size_t block,
                   std::int64_t firing,
                   const FiringSlots& slots) const;

  Sensor& sensor_;
  RayCaster& scene_;
  Traffic& traffic_;
  StatusCycle status_;
  Settings settings_;
  std::vector<FiringSlots> slots_;
  std::uint64_t next_ = 0;
};

}  // namespace pago::simulator
