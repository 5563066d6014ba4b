// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "socket.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "pago/config/packet_filter.hpp"
#include "pago/core/error.hpp"

namespace pago::udp {

namespace {

std::string hint_for(int error) {
  switch (error) {
    case EADDRINUSE:
      return "another program has the port, perhaps another pago: `ss -ulnp` shows which";
    case EADDRNOTAVAIL:
      return "no interface of this host has the address: `ip -brief address` lists them";
    case EACCES:
      return "ports below 1024 need privileges";
    default:
      return {};
  }
}

void set_option(int fd, int option, int value) noexcept {
  setsockopt(fd, SOL_SOCKET, option, &value, sizeof value);
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}

int open_receiver(const UdpEndpoint& endpoint) {
  const std::string where = to_string(endpoint);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(checked_port(endpoint.port, where));
  if (!endpoint.address.empty())
    address.sin_addr.s_addr = htonl(
        parse_ipv4(endpoint.address, where, "leave it empty (udp://:2368) to listen on all interfaces"));

  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw Error(where, "no socket: " + std::generic_category().message(errno));
  set_option(fd, SO_TIMESTAMPNS, 1);
  set_option(fd, SO_RXQ_OVFL, 1);
  if (bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    const int error = errno;
    close(fd);
    throw Error(where, "cannot listen: " + std::generic_category().message(error), hint_for(error));
  }
  return fd;
}

int ask_receive_buffer(int fd, int bytes) noexcept {
  if (setsockopt(fd, SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) != 0) set_option(fd, SO_RCVBUF, bytes);
  int granted = 0;
  socklen_t length = sizeof granted;
  getsockopt(fd, SOL_SOCKET, SO_RCVBUF, &granted, &length);
  return granted;
}

int bound_port(int fd) noexcept {
  sockaddr_in address{};
  socklen_t length = sizeof address;
  getsockname(fd, reinterpret_cast<sockaddr*>(&address), &length);
  return ntohs(address.sin_port);
}

}  // namespace pago::udp
