// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/udp/udp_source.hpp"

namespace pago::udp {

/// An open file descriptor, closed with its owner.
class Descriptor {
 public:
  explicit Descriptor(int fd) noexcept : fd_(fd) {}
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const noexcept { return fd_; }

 private:
  int fd_;
};

/// A bound UDP socket that stamps arrivals and counts what it drops. Throws Error. The caller owns it.
int open_receiver(const UdpEndpoint& endpoint);

/// Asks for a receive buffer, past the host's limit where we may; returns what was granted, in the kernel's
/// measure (twice what is asked).
int ask_receive_buffer(int fd, int bytes) noexcept;

int bound_port(int fd) noexcept;

}  // namespace pago::udp
