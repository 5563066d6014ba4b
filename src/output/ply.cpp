// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/ply.hpp"

#include <array>
#include <bit>
#include <string>

#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {
namespace {

void put(std::string& bytes, float value) {
  auto word = std::bit_cast<std::uint32_t>(value);
  for (int byte = 0; byte < 4; ++byte, word >>= 8U) bytes += static_cast<char>(word & 0xFFU);
}

void put(std::string& bytes, const PlyPoint& point) {
  for (const float value : {point.x_m, point.y_m, point.z_m}) put(bytes, value);
  bytes += static_cast<char>(point.intensity);
  bytes += static_cast<char>(point.ground);
}

std::string header(std::size_t num_points) {
  return "ply\nformat binary_little_endian 1.0\ncomment PaGO map, metres, z up\nelement vertex " +
         std::to_string(num_points) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty uchar intensity\n"
         "property uchar ground\nend_header\n";
}

}  // namespace

void write_ply(const std::filesystem::path& file, std::span<const PlyPoint> points) {
  constexpr std::size_t kBlock = 65'536;
  TextFile out(file);
  out.write(header(points.size()));
  std::string bytes;
  for (std::size_t start = 0; start < points.size(); start += kBlock) {
    bytes.clear();
    for (const PlyPoint& point : points.subspan(start, std::min(kBlock, points.size() - start)))
      put(bytes, point);
    out.write(bytes);
  }
  out.flush();
  out.throw_if_incomplete();
}

}  // namespace pago::output
