// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <vector>

#include "pago/core/sweep.hpp"

namespace pago::test {

/// All numbers of a binary file, in this machine's byte order (little endian, as KITTI's).
template <typename T>
std::vector<T> read_binary(const std::filesystem::path& file) {
  std::vector<T> values(std::filesystem::file_size(file) / sizeof(T));
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(values.size() * sizeof(T)));
  if (!in) throw std::runtime_error("cannot read " + file.string());
  return values;
}

/// The points of a KITTI .bin file, in file order, with neither rings nor columns nor range image: what the
/// methods that only look at coordinates need. Replaces what the sweep held.
inline void load_kitti_points(const std::filesystem::path& file, Sweep& sweep) {
  const std::vector<float> values = read_binary<float>(file);
  if (values.size() / 4 > sweep.capacity()) throw std::runtime_error("sweep too small for " + file.string());
  sweep.reset();
  sweep.size = static_cast<std::uint32_t>(values.size() / 4);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    sweep.x_m[i] = values[4 * i];
    sweep.y_m[i] = values[4 * i + 1];
    sweep.z_m[i] = values[4 * i + 2];
    sweep.intensity[i] =
        static_cast<std::uint8_t>(std::lround(255.0F * std::clamp(values[4 * i + 3], 0.0F, 1.0F)));
  }
}

/// The .bin files of a folder, in order.
inline std::vector<std::filesystem::path> kitti_scans(const std::filesystem::path& velodyne_folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(velodyne_folder))
    if (entry.path().extension() == ".bin") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace pago::test
