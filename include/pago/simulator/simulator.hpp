// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <memory>

#include "pago/config/hdl64.hpp"
#include "pago/config/simulator.hpp"
#include "pago/core/mount.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/packet.hpp"
#include "pago/hdl64/stream_format.hpp"

namespace pago::simulator {

inline constexpr std::size_t kSlotsPerPacket = hdl64::kBlocks * hdl64::kLasersPerBlock;

/// A datagram, and what no sensor can tell.
struct SimulatedPacket {
  std::array<std::uint8_t, hdl64::kPacketBytes> bytes{};
  std::int64_t time_ns = 0;     ///< sensor time of its first firing, since the Unix epoch
  std::int64_t arrival_ns = 0;  ///< when a host would get it
  /// SemanticKITTI class of what each of its slots returned from; block x 32 + laser in the block.
  std::array<std::uint16_t, kSlotsPerPacket> labels{};
};

/// One rotation, from cut to cut behind the vehicle.
struct SweepTimes {
  std::int64_t start_ns = 0, mid_ns = 0, end_ns = 0;
};

/// A drive through a made-up world, packet by packet. Every random number is a function of the seed and of
/// what it is for, and ray casting runs on one thread: the same settings give the same bytes.
///
/// [set-up] the constructor: lays out the world, throws Error for a calibration or path file that cannot be
/// used; [one thread] next(): allocates when new land comes into sight.
class Simulator {
 public:
  Simulator(const SimulatorConfig& config, const Hdl64Config& sensor, const Mount& mount);
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  /// Makes the next packet; false when the drive is over.
  bool next(SimulatedPacket& packet);

  /// Goes on with the packet that fires at `time_ns`, or one a few before it, later or earlier in the drive.
  /// What lies between is not rendered and costs nothing; what follows is the same as without it.
  void skip_to(std::int64_t time_ns) noexcept;

  /// The unit's calibration file, which the unit keeps to as well as the settings say.
  const hdl64::Calibration& calibration() const noexcept;

  /// Of its packets.
  hdl64::StreamFormat format() const noexcept;

  /// Sensor time of the drive's first firing.
  std::int64_t start_ns() const noexcept;
  std::int64_t duration_ns() const noexcept;
  std::uint64_t num_packets() const noexcept;
  /// Whole rotations of the drive, and those that are over at an instant.
  std::uint64_t num_sweeps() const noexcept;
  std::uint64_t sweeps_until(std::int64_t time_ns) const noexcept;
  SweepTimes sweep(std::uint64_t index) const noexcept;
  /// The truth, exact at any sensor time within the drive.
  Eigen::Isometry3d T_world_sensor(std::int64_t time_ns) const noexcept;
  /// The head's true azimuth in revolutions, clockwise; a whole number is ahead.
  double revolutions(std::int64_t time_ns) const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago::simulator
