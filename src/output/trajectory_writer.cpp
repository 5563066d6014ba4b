// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/trajectory_writer.hpp"

#include <cinttypes>

#include "pago/core/text.hpp"

namespace pago::output {
namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

/// All digits; a double would lose those below 0.2 us.
std::string seconds(std::int64_t stamp_ns) {
  const std::int64_t whole = stamp_ns / kNsPerSecond, rest = stamp_ns % kNsPerSecond;
  return format("%s%" PRId64 ".%09" PRId64, stamp_ns < 0 ? "-" : "", whole < 0 ? -whole : whole,
                rest < 0 ? -rest : rest);
}

}  // namespace

std::string tum_line(std::int64_t stamp_ns, const PoseRow& pose) {
  const Eigen::Isometry3d T = to_isometry(pose);
  const Eigen::Vector3d& t = T.translation();
  const Eigen::Quaterniond q(T.linear());
  return seconds(stamp_ns) + format(" %.12f %.12f %.12f %.12f %.12f %.12f %.12f\n", t.x(), t.y(), t.z(),
                                    q.x(), q.y(), q.z(), q.w());
}

std::string kitti_line(const PoseRow& pose) {
  std::string line;
  for (const double number : pose) line += format("%.16e ", number);
  line.back() = '\n';
  return line;
}

TrajectoryWriter::TrajectoryWriter(const std::filesystem::path& folder, const std::string& name)
    : tum_(folder / (name + ".tum")), kitti_(folder / (name + ".kitti")) {}

void TrajectoryWriter::write(std::int64_t stamp_ns, const PoseRow& pose) noexcept {
  tum_.write(tum_line(stamp_ns, pose));
  kitti_.write(kitti_line(pose));
}

void TrajectoryWriter::flush() noexcept {
  tum_.flush();
  kitti_.flush();
}

const std::string& TrajectoryWriter::complaint() const noexcept {
  return tum_.complaint().empty() ? kitti_.complaint() : tum_.complaint();
}

}  // namespace pago::output
