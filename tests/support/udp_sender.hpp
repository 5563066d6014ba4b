// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <span>
#include <stdexcept>

namespace pago::test {

/// Sends datagrams to a port of this host, from an address of the loopback range: any of 127.0.0.1 to
/// 127.255.255.254 serves as a sensor of its own.
class UdpSender {
 public:
  explicit UdpSender(int port, const char* from = "127.0.0.1") : fd_(socket(AF_INET, SOCK_DGRAM, 0)) {
    sockaddr_in source{};
    source.sin_family = AF_INET;
    inet_pton(AF_INET, from, &source.sin_addr);
    if (fd_ < 0 || bind(fd_, reinterpret_cast<const sockaddr*>(&source), sizeof source) != 0)
      throw std::runtime_error("no socket to send from");
    to_.sin_family = AF_INET;
    to_.sin_port = htons(static_cast<std::uint16_t>(port));
    to_.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  }
  ~UdpSender() { close(fd_); }
  UdpSender(const UdpSender&) = delete;
  UdpSender& operator=(const UdpSender&) = delete;

  void send(std::span<const std::uint8_t> payload) {
    if (sendto(fd_, payload.data(), payload.size(), 0, reinterpret_cast<const sockaddr*>(&to_), sizeof to_) <
        0)
      throw std::runtime_error("cannot send");
  }

 private:
  int fd_;
  sockaddr_in to_{};
};

}  // namespace pago::test
