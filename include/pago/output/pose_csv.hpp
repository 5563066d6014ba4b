// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pago/core/estimate.hpp"
#include "pago/output/sweep_record.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

/// poses.csv: what a trajectory file has no room for. Row i belongs to row i of the trajectory files.
/// Columns: sequence, stamp_ns, health, reason, and the upper half of Estimate::covariance row by row, x_x,
/// x_y, ... yaw_yaw. [one thread] not real-time.
class PoseCsv {
 public:
  /// [set-up] Error when the file cannot be made.
  explicit PoseCsv(const std::filesystem::path& file);

  /// The record must have a pose.
  void write(const SweepRecord& record) noexcept;
  void flush() noexcept { file_.flush(); }
  const std::string& complaint() const noexcept { return file_.complaint(); }

 private:
  TextFile file_;
};

/// A row of poses.csv.
struct PoseFacts {
  std::uint64_t sequence = 0;
  std::int64_t stamp_ns = 0;
  std::string health, reason;
  Matrix6d covariance = Matrix6d::Zero();
};

/// [set-up] Error for a file that is not a poses.csv.
std::vector<PoseFacts> read_poses_csv(const std::filesystem::path& file);

}  // namespace pago::output
