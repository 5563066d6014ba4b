// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pago/config/simulator.hpp"
#include "pago/simulator/simulator.hpp"
#include "random.hpp"

namespace pago::simulator {

/// What a host gets.
struct SentPacket {
  std::array<std::uint8_t, hdl64::kPacketBytes> bytes{};
  std::size_t size = hdl64::kPacketBytes;
  std::int64_t arrival_ns = 0;

  std::span<const std::uint8_t> payload() const noexcept { return std::span(bytes).first(size); }
};

/// The way from the sensor to the host, where packets get lost and worse. Without faults each arrives once as
/// it is. What happens to a packet is a function of the seed and of the packet's number. [one thread]
class FaultyWay {
 public:
  /// `start_ns`: sensor time of the drive's beginning.
  FaultyWay(const SimulatorFaults& faults, std::int64_t start_ns, std::uint64_t seed);

  /// Appends what arrives because of this packet: nothing, it, or several; at most kMost.
  void pass(const SimulatedPacket& packet, std::vector<SentPacket>& arrived);
  /// The drive is over: appends what was still held back.
  void finish(std::vector<SentPacket>& arrived);

  static constexpr std::size_t kMost = 8;

 private:
  struct Late {
    SentPacket packet;
    int after = 0;  ///< packets
  };
  bool is_silent(double t_s) const noexcept;
  bool is_in_burst(Random& random) noexcept;
  void damage(SentPacket& packet, Random& random) const noexcept;
  void restart_stamp(SentPacket& packet, double t_s) const noexcept;
  void deliver_late(int packets_later, std::vector<SentPacket>& arrived);

  SimulatorFaults faults_;
  std::int64_t start_ns_;
  std::uint64_t seed_, number_ = 0;
  int burst_left_ = 0;
  std::vector<Late> late_;
};

}  // namespace pago::simulator
