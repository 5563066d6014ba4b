// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/ply.hpp"

#include <bit>
#include <initializer_list>
#include <string>

#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {
namespace {

void put(std::string& bytes, float value) {
  auto word = std::bit_cast<std::uint32_t>(value);
  for (int byte = 0; byte < 4; ++byte, word >>= 8U) bytes += static_cast<char>(word & 0xFFU);
}

float float_at(const char* bytes) noexcept {
  std::uint32_t word = 0;
  for (int byte = 3; byte >= 0; --byte) word = word << 8U | static_cast<std::uint8_t>(bytes[byte]);
  return std::bit_cast<float>(word);
}

void put(std::string& bytes, const ColouredPoint& point) {
  for (const float value : {point.x_m, point.y_m, point.z_m}) put(bytes, value);
  for (const std::uint8_t part : point.colour) bytes += static_cast<char>(part);
}

std::string header(const char* what, std::uint64_t num_points, std::initializer_list<const char*> bytes) {
  std::string text = std::string("ply\nformat binary_little_endian 1.0\ncomment PaGO ") + what +
                     ", metres, z up\nelement vertex " + std::to_string(num_points) +
                     "\nproperty float x\nproperty float y\nproperty float z\n";
  for (const char* name : bytes) text += std::string("property uchar ") + name + "\n";
  return text + "end_header\n";
}

}  // namespace

void append(std::string& bytes, const PlyPoint& point) {
  for (const float value : {point.x_m, point.y_m, point.z_m}) put(bytes, value);
  bytes += static_cast<char>(point.intensity);
  bytes += static_cast<char>(point.ground);
}

PlyPoint ply_point(const char* bytes) noexcept {
  return {.x_m = float_at(bytes),
          .y_m = float_at(bytes + 4),
          .z_m = float_at(bytes + 8),
          .intensity = static_cast<std::uint8_t>(bytes[12]),
          .ground = static_cast<std::uint8_t>(bytes[13])};
}

std::string map_header(std::uint64_t num_points) {
  return header("map", num_points, {"intensity", "ground"});
}

void write_ply(const std::filesystem::path& file, std::span<const ColouredPoint> points) {
  constexpr std::size_t kBlock = 65'536;
  TextFile out(file);
  out.write(header("scan", points.size(), {"red", "green", "blue"}));
  std::string bytes;
  for (std::size_t start = 0; start < points.size(); start += kBlock) {
    bytes.clear();
    for (const ColouredPoint& point : points.subspan(start, std::min(kBlock, points.size() - start)))
      put(bytes, point);
    out.write(bytes);
  }
  out.flush();
  out.throw_if_incomplete();
}

}  // namespace pago::output
