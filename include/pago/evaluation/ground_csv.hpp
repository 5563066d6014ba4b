// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pago/evaluation/ground_metrics.hpp"

namespace pago::evaluation {

/// A row of ground.csv: how a method's mask of one frame compares with the labels.
/// Columns: frame, method, protocol, tp, fp, fn, tn. The protocol is the letter A or B; a file without the
/// column `method` is of one method without a name.
struct GroundRow {
  std::uint64_t frame = 0;  ///< sweep or scan number
  std::string method;       ///< "patchwork", ...
  GroundCounts counts;      ///< `excluded` is not in the file
};

std::string_view ground_csv_header() noexcept;      ///< without line feed
std::string ground_csv_line(const GroundRow& row);  ///< without line feed

/// [set-up] Error for another file, or another letter than A and B.
std::vector<GroundRow> read_ground_csv(const std::filesystem::path& file);

/// The frames of one method under one protocol, in the order of the file.
struct GroundSeries {
  std::string method;
  GroundProtocol protocol = GroundProtocol::kPatchwork;
  std::vector<std::uint64_t> frames;
  std::vector<GroundCounts> counts;
};
/// Sorted apart, in the order of their first rows: two protocols are never mixed.
std::vector<GroundSeries> ground_series(const std::vector<GroundRow>& rows);

}  // namespace pago::evaluation
