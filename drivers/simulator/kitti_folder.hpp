// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "pago/config/hdl64.hpp"
#include "pago/hdl64/firing_decoder.hpp"
#include "pago/simulator/simulator.hpp"

namespace pago::simulator {

/// Writes a drive as KITTI's odometry benchmark with SemanticKITTI's labels has it: ring by ring from the
/// top, each ring starting ahead and going round to the left. Points are decoded as PaGO decodes packets,
/// with the head's true azimuth. Throws Error when a file cannot be written.
class KittiFolderWriter {
 public:
  KittiFolderWriter(const Simulator& drive,
                    const Hdl64Config& sensor,
                    const std::filesystem::path& folder,
                    bool is_compensated);

  void add(const SimulatedPacket& packet);
  /// Writes times, poses and calibration of this many scans; an unfinished last one is left out.
  void finish(std::uint64_t num_scans);

 private:
  struct Point {
    float x_m, y_m, z_m, intensity;
    std::uint32_t label;
    float turn_rad;  ///< around to the left from ahead, [0, 2 pi)
  };
  void add_firing(const SimulatedPacket& packet, int firing);
  void write_scan();

  const Simulator& drive_;
  hdl64::FiringDecoder decoder_;
  std::filesystem::path folder_;
  bool is_compensated_;
  std::uint64_t scan_ = 0;
  std::array<std::vector<Point>, hdl64::kLasers> rings_;
  Eigen::Isometry3d T_mid_world_ = Eigen::Isometry3d::Identity();  // of the scan's middle
};

}  // namespace pago::simulator
