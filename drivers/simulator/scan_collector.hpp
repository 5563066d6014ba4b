// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "pago/config/hdl64.hpp"
#include "pago/hdl64/packet_decoder.hpp"
#include "pago/simulator/simulator.hpp"

namespace pago::simulator {

/// A return with its truth, in the frame `sensor` at its own firing or in the middle of its scan.
struct LabelledPoint {
  float x_m, y_m, z_m, intensity;  ///< intensity 0 to 1
  float turn_rad;                  ///< around to the left from ahead, [0, 2 pi)
  std::uint32_t label;             ///< SemanticKITTI's class
};

/// One rotation, ring by ring, 0 the lowest; each ring from ahead around to the left.
using LabelledRings = std::array<std::vector<LabelledPoint>, hdl64::kLasers>;

/// Packets of a drive into whole rotations, of a dual-return unit its strongest returns. Points are decoded
/// as PaGO decodes packets, with the head's true azimuth. [one thread]
class ScanCollector {
 public:
  using Use = std::function<void(std::uint64_t scan, const LabelledRings&)>;

  /// `is_compensated`: points in the frame of their rotation's middle. `use` is called for each complete
  /// scan.
  ScanCollector(const Simulator& drive, const Hdl64Config& sensor, bool is_compensated, Use use);

  void add(const SimulatedPacket& packet);
  /// The drive is over; its last scan counts if it is one of `num_scans`.
  void finish(std::uint64_t num_scans);

 private:
  void begin(std::uint64_t scan);
  void end();
  void decode(const SimulatedPacket& packet);
  void add_firing(const SimulatedPacket& packet, int firing);

  const Simulator& drive_;
  hdl64::StreamFormat format_;
  hdl64::PacketDecoder decoder_;
  hdl64::PacketReturns returns_{};
  bool is_compensated_;
  Use use_;
  std::uint64_t scan_ = 0;
  LabelledRings rings_;
  Eigen::Isometry3d T_mid_world_ = Eigen::Isometry3d::Identity();  // of the scan's middle
};

}  // namespace pago::simulator
