// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/pose_sender.hpp"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <system_error>

#include "pago/config/packet_filter.hpp"
#include "pago/core/error.hpp"

namespace pago::output {

namespace {

constexpr auto kWhere = "publish.udp";
constexpr auto kForm = "write ADDRESS:PORT, for example 127.0.0.1:9760";

sockaddr_in parse_destination(const std::string& text) {
  const std::size_t colon = text.rfind(':');
  int port = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, fault] =
      std::from_chars(colon == std::string::npos ? end : text.data() + colon + 1, end, port);
  if (fault != std::errc{} || stop != end || port < 1 || port > 65535)
    throw Error(kWhere, "'" + text + "' names no port", kForm);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(parse_ipv4(text.substr(0, colon), kWhere, kForm));
  return to;
}

}  // namespace

PoseSender::PoseSender(const std::string& destination) {
  const sockaddr_in to = parse_destination(destination);
  fd_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (fd_ >= 0 && connect(fd_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0) return;
  const int error = errno;
  if (fd_ >= 0) close(fd_);
  throw Error(kWhere, "cannot send to " + destination + ": " + std::generic_category().message(error));
}

PoseSender::~PoseSender() {
  close(fd_);
}

void PoseSender::send(const PoseV1& pose) noexcept {
  const auto try_send = [&] { return ::send(fd_, &pose, sizeof pose, 0) == sizeof pose; };
  if (try_send()) return;
  // Refused: nobody listened to the last one. That is no fault, but it kept this one from being sent.
  if (errno == ECONNREFUSED && try_send()) return;
  ++unsent_;
}

}  // namespace pago::output
