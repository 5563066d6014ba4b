// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/pose_csv.hpp"

#include <array>
#include <cinttypes>

#include "pago/core/csv.hpp"
#include "pago/core/text.hpp"

namespace pago::output {
namespace {

constexpr Eigen::Index kSize = 6;
constexpr std::array<const char*, kSize> kAxes{"x", "y", "z", "roll", "pitch", "yaw"};

std::string covariance_column(Eigen::Index row, Eigen::Index column) {
  return format("%s_%s", kAxes[static_cast<std::size_t>(row)], kAxes[static_cast<std::size_t>(column)]);
}

}  // namespace

PoseCsv::PoseCsv(const std::filesystem::path& file) : file_(file) {
  std::string header = "sequence,stamp_ns,health,reason";
  for (Eigen::Index i = 0; i < kSize; ++i)
    for (Eigen::Index j = i; j < kSize; ++j) header.append(",").append(covariance_column(i, j));
  file_.write(header + "\n");
}

void PoseCsv::write(const SweepRecord& record) noexcept {
  std::string row =
      format("%" PRIu64 ",%" PRId64 ",%s,%s", record.header.sequence, record.stamp_ns,
             std::string(to_string(record.health)).c_str(), std::string(to_string(record.reason)).c_str());
  for (std::size_t i = 0; i < kSize; ++i)
    for (std::size_t j = i; j < kSize; ++j) row += format(",%.9e", record.covariance[kSize * i + j]);
  file_.write(row + "\n");
}

std::vector<PoseFacts> read_poses_csv(const std::filesystem::path& file) {
  const CsvTable table = CsvTable::read(file);
  const std::size_t sequence = table.at("sequence"), stamp = table.at("stamp_ns");
  const std::size_t health = table.at("health"), reason = table.at("reason");
  std::vector<PoseFacts> poses(table.num_rows());
  for (std::size_t row = 0; row < poses.size(); ++row)
    poses[row] = {table.count(row, sequence), table.integer(row, stamp), table.text(row, health),
                  table.text(row, reason), Matrix6d::Zero()};
  for (Eigen::Index i = 0; i < kSize; ++i)
    for (Eigen::Index j = i; j < kSize; ++j) {
      const std::size_t column = table.at(covariance_column(i, j));
      for (std::size_t row = 0; row < poses.size(); ++row)
        poses[row].covariance(i, j) = poses[row].covariance(j, i) = table.number(row, column);
    }
  return poses;
}

}  // namespace pago::output
