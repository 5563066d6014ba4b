// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

namespace pago::platform {

/// Memory that other processes can map by name (shm_overview(7)), or that is this process's own. Zero-filled,
/// page-aligned, touched. One process at a time owns a name; who dies without tidying up loses it to the
/// next. What the dead one left is not used again, as somebody may still read it: its first 32-bit word
/// becomes 0, which tells readers to look for the new one, and a new object takes its place.
class SharedMemory {
 public:
  /// [set-up] Makes /dev/shm/NAME, readable by everybody; an empty name makes private memory. Throws Error if
  /// the name is not valid, if a running process owns it, or if there is no memory.
  SharedMemory(const std::string& name, std::size_t bytes);
  ~SharedMemory();
  SharedMemory(const SharedMemory&) = delete;
  SharedMemory& operator=(const SharedMemory&) = delete;

  void* data() noexcept { return data_; }

 private:
  std::string name_;
  std::size_t bytes_;
  int fd_ = -1;
  void* data_ = nullptr;
};

}  // namespace pago::platform
