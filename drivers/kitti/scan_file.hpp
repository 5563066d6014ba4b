// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pago/core/aligned_array.hpp"

namespace pago::kitti {

/// A point as KITTI's .bin files hold it; metres, little-endian.
struct FilePoint {
  float x_m, y_m, z_m, intensity;
};
static_assert(sizeof(FilePoint) == 16);

/// Why a scan cannot be used.
struct ScanFault {
  enum class Kind : std::uint8_t { kNone, kOpen, kRead, kEmpty, kPartialPoint, kTooLong, kLabels };
  Kind kind = Kind::kNone;
  int system_error = 0;       ///< errno of kOpen and kRead
  std::uint64_t byte = 0;     ///< where in the file; kLabels: how many bytes it has
  bool is_of_labels = false;  ///< about the scan's labels, not its points
};

/// One line about it, beginning with the file's name.
std::string describe(const ScanFault& fault, const std::string& path);

/// Reads the classes (low 16 bits) of a file of SemanticKITTI labels, one little-endian uint32 per point.
/// False on a fault, which it sets: the file cannot be read, or has not as many labels as `classes`.
/// Real-time safe but for the file.
bool read_labels(const char* path, std::span<std::uint16_t> classes, ScanFault& fault) noexcept;

/// Reads scan files into memory of its own. [set-up] the constructor allocates; read() does not.
class ScanReader {
 public:
  explicit ScanReader(std::size_t max_points) : points_(max_points + 1) {}

  /// The points of the file, valid until the next call; `max_points` of this call may be less than the
  /// reader's. Empty on a fault, which it sets.
  std::span<const FilePoint> read(const char* path, std::size_t max_points, ScanFault& fault) noexcept;

 private:
  AlignedArray<FilePoint> points_;  // one more than allowed, to see that a file is too long
};

}  // namespace pago::kitti
