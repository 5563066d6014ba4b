// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scan_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cerrno>
#include <cstring>

namespace pago::kitti {
namespace {

static_assert(std::endian::native == std::endian::little, "scan files are read without swapping bytes");

/// Reads up to `size` bytes; fewer only at the end of the file. -1: failed, see errno.
ssize_t read_up_to(int file, void* to, std::size_t size) noexcept {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t got = ::read(file, static_cast<char*>(to) + done, size - done);
    if (got == 0) break;
    if (got < 0 && errno != EINTR) return -1;
    if (got > 0) done += static_cast<std::size_t>(got);
  }
  return static_cast<ssize_t>(done);
}

}  // namespace

std::string describe(const ScanFault& fault, const std::string& path) {
  const std::string byte = std::to_string(fault.byte);
  switch (fault.kind) {
    case ScanFault::Kind::kNone:
      return {};
    case ScanFault::Kind::kOpen:
      return path + ": cannot be opened: " + std::strerror(fault.system_error);
    case ScanFault::Kind::kRead:
      return path + ": cannot be read: " + std::strerror(fault.system_error);
    case ScanFault::Kind::kEmpty:
      return path + ": is empty";
    case ScanFault::Kind::kPartialPoint:
      return path + ": ends inside a point, which begins at byte " + byte + " (a point has 16 bytes)";
    case ScanFault::Kind::kTooLong:
      return path + ": more points than a sweep can hold, from byte " + byte + " on";
    case ScanFault::Kind::kLabels:
      return path + ": has " + byte + " bytes, not 4 for each point of its scan (is it of another one?)";
  }
  return {};
}

bool read_labels(const char* path, std::span<std::uint16_t> classes, ScanFault& fault) noexcept {
  using Kind = ScanFault::Kind;
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    fault = {Kind::kOpen, errno, 0, true};
    return false;
  }
  std::array<std::uint32_t, 4096> block{};  // labels need no more memory than that
  std::uint64_t bytes = 0;
  ssize_t got = 0;
  do {
    got = read_up_to(file, block.data(), sizeof block);
    if (got < 0) fault = {Kind::kRead, errno, 0, true};
    for (std::size_t k = 0; 4 * (k + 1) <= static_cast<std::size_t>(std::max<ssize_t>(0, got)); ++k) {
      const std::size_t i = bytes / 4 + k;
      if (i < classes.size()) classes[i] = static_cast<std::uint16_t>(block[k] & 0xFFFFU);
    }
    bytes += static_cast<std::uint64_t>(std::max<ssize_t>(0, got));
  } while (got == static_cast<ssize_t>(sizeof block));
  ::close(file);
  if (got >= 0 && bytes != 4 * classes.size()) fault = {Kind::kLabels, 0, bytes, true};
  return got >= 0 && bytes == 4 * classes.size();
}

std::span<const FilePoint> ScanReader::read(const char* path,
                                            std::size_t max_points,
                                            ScanFault& fault) noexcept {
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) {
    fault = {ScanFault::Kind::kOpen, errno, 0};
    return {};
  }
  const ssize_t got = read_up_to(file, points_.data(), points_.size() * sizeof(FilePoint));
  const int error = errno;
  ::close(file);
  if (got < 0) {
    fault = {ScanFault::Kind::kRead, error, 0};
    return {};
  }
  const auto bytes = static_cast<std::size_t>(got);
  const std::size_t num_points = bytes / sizeof(FilePoint);
  max_points = std::min(max_points, points_.size() - 1);
  if (bytes == 0) fault = {ScanFault::Kind::kEmpty, 0, 0};
  if (bytes % sizeof(FilePoint) != 0)
    fault = {ScanFault::Kind::kPartialPoint, 0, num_points * sizeof(FilePoint)};
  if (num_points > max_points) fault = {ScanFault::Kind::kTooLong, 0, max_points * sizeof(FilePoint)};
  if (fault.kind != ScanFault::Kind::kNone) return {};
  return points_.first(num_points);
}

}  // namespace pago::kitti
