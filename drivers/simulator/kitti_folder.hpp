// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scan_collector.hpp"

namespace pago::simulator {

/// Writes scans as KITTI's odometry benchmark with SemanticKITTI's labels has them: ring by ring from the
/// top, each ring starting ahead and going round to the left. All throw Error when a file cannot be written.
class KittiFolder {
 public:
  explicit KittiFolder(const std::filesystem::path& folder);

  void write_scan(std::uint64_t scan, const LabelledRings& rings) const;
  /// times.txt, poses.txt (of the camera, mid-scan, from the first) and calib.txt.
  void finish(const Simulator& drive, std::uint64_t num_scans) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace pago::simulator
