// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "pago/output/sweep_record.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

/// Writes one trajectory in two formats, one line per pose:
///   NAME.tum    stamp_s x y z qx qy qz qw, stamps to the nanosecond, the rest with 12 decimals
///   NAME.kitti  the pose's 3 x 4 numbers row by row with 17 significant digits: reading them back gives the
///               same doubles
/// [one thread] not real-time.
class TrajectoryWriter {
 public:
  /// [set-up] Makes both files in an existing folder; Error when that cannot be done.
  TrajectoryWriter(const std::filesystem::path& folder, const std::string& name);

  void write(std::int64_t stamp_ns, const PoseRow& pose) noexcept;
  void flush() noexcept;

  /// Empty, or why a file is incomplete; certain only after flush().
  const std::string& complaint() const noexcept;

 private:
  TextFile tum_, kitti_;
};

/// One line of each format, with its line feed.
std::string tum_line(std::int64_t stamp_ns, const PoseRow& pose);
std::string kitti_line(const PoseRow& pose);

}  // namespace pago::output
