// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pago::output {

/// A file descriptor that is closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int fd = -1) noexcept : fd_(fd) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  int get() const noexcept { return fd_; }
  bool is_open() const noexcept { return fd_ >= 0; }

 private:
  int fd_;
};

/// Connected to the socket at `path`; not open if nobody listens there.
Descriptor connect_to(const std::string& path);

/// Listening at `path`, for this user alone, without blocking. Throws Error.
Descriptor listen_at(const std::string& path);

}  // namespace pago::output
