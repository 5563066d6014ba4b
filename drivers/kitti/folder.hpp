// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pago/config/drivers.hpp"

namespace pago::kitti {

/// One file to read.
struct Scan {
  std::string path;
  std::string label_path;                 ///< empty: no labels, or not wanted
  std::uint64_t sequence = 0;             ///< file number, counted from the first scan that is read
  std::int64_t start_ns = 0, end_ns = 0;  ///< of the rotation, around the file's stamp
  bool is_after_gap = false;              ///< file numbers are missing before it
  bool is_last_of_folder = false;
};

struct Folder {
  std::vector<Scan> scans;  ///< in the order of their file numbers, as `first` and `count` select them
  bool is_raw = false;      ///< layout of the raw recordings
  bool has_stamps = false;
};

/// Finds the scans and their stamps. Throws Error: no such folder, no scans (left), stamps that do not match.
Folder open_folder(const std::filesystem::path& folder, const KittiConfig& config);

}  // namespace pago::kitti
