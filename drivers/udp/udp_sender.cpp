// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/udp/udp_sender.hpp"

#include <netinet/in.h>
#include <netinet/udp.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <system_error>

#include "pago/config/packet_filter.hpp"
#include "pago/core/error.hpp"
#include "socket.hpp"

namespace pago {

namespace {

constexpr std::size_t kBatch = 64;
constexpr std::size_t kMaxSegmented_bytes = 60'000;  // of what the kernel takes as one: below 64 KiB

int open_sender(const std::string& where) {
  const int fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  if (fd < 0) throw Error(where, "no socket: " + std::generic_category().message(errno));
  const int on = 1;
  setsockopt(fd, SOL_SOCKET, SO_BROADCAST, &on, sizeof on);
  return fd;
}

}  // namespace

struct UdpSender::State {
  explicit State(const UdpEndpoint& to) : socket(open_sender(to_string(to))) {
    const std::string where = to_string(to);
    destination.sin_family = AF_INET;
    destination.sin_port = htons(checked_port(to.port, where));
    const std::string address = to.address.empty() ? "127.0.0.1" : to.address;
    destination.sin_addr.s_addr = htonl(parse_ipv4(address, where, "write 127.0.0.1:2368"));
    if (to.port == 0) throw Error(where, "names no port", "write 127.0.0.1:2368");
  }

  udp::Descriptor socket;
  sockaddr_in destination{};
  std::array<iovec, kBatch> vectors{};
  std::array<mmsghdr, kBatch> messages{};
  std::uint64_t sent = 0, unsent = 0;
  bool segments = true;  // the kernel and the interface take many datagrams as one; found out by trying
  int segment_bytes = 0;

  bool set_segment(int bytes) noexcept {
    if (bytes == segment_bytes) return true;
    segment_bytes = bytes;
    return setsockopt(socket.get(), SOL_UDP, UDP_SEGMENT, &bytes, sizeof bytes) == 0;
  }
  void send_each(std::size_t first, std::size_t end) noexcept;
  bool send_as_one(std::size_t first, std::size_t end) noexcept;
};

UdpSender::UdpSender(const UdpEndpoint& destination) : state_(std::make_unique<State>(destination)) {}
UdpSender::~UdpSender() = default;

void UdpSender::State::send_each(std::size_t first, std::size_t end) noexcept {
  while (first < end) {
    const int done = sendmmsg(socket.get(), &messages[first], static_cast<unsigned>(end - first), 0);
    sent += done > 0 ? static_cast<std::uint64_t>(done) : 0;
    // An error concerns the first message that was not sent: pass over it.
    unsent += done <= 0 ? 1U : 0U;
    first += done > 0 ? static_cast<std::size_t>(done) : 1;
  }
}

// Datagrams of one size go down the kernel's stack as one and are cut apart at its end (UDP_SEGMENT): a third
// of the cost. False: nothing was sent.
bool UdpSender::State::send_as_one(std::size_t first, std::size_t end) noexcept {
  if (!set_segment(static_cast<int>(vectors[first].iov_len))) return false;
  msghdr message = messages[first].msg_hdr;
  message.msg_iov = &vectors[first];
  message.msg_iovlen = end - first;
  if (sendmsg(socket.get(), &message, 0) < 0) return false;
  sent += end - first;
  return true;
}

void UdpSender::send(std::span<const Datagram> datagrams) noexcept {
  State& s = *state_;
  const std::size_t count = std::min(datagrams.size(), kBatch);
  for (std::size_t i = 0; i < count; ++i) {
    // sendmmsg() reads only, but its vectors are those of receiving too.
    s.vectors[i] = {const_cast<std::uint8_t*>(datagrams[i].payload.data()), datagrams[i].payload.size()};
    s.messages[i] = {};
    s.messages[i].msg_hdr.msg_name = &s.destination;
    s.messages[i].msg_hdr.msg_namelen = sizeof s.destination;
    s.messages[i].msg_hdr.msg_iov = &s.vectors[i];
    s.messages[i].msg_hdr.msg_iovlen = 1;
  }
  for (std::size_t first = 0, end = 0; first < count; first = end) {
    const std::size_t size = s.vectors[first].iov_len;
    for (end = first + 1; end < count && s.vectors[end].iov_len == size; ++end) {
      if ((end - first + 1) * size > kMaxSegmented_bytes) break;
    }
    const bool is_run = s.segments && end > first + 1 && size > 0;
    if (is_run && s.send_as_one(first, end)) continue;
    if (is_run) s.segments = false;
    s.set_segment(0);
    s.send_each(first, end);
  }
}

std::uint64_t UdpSender::sent() const noexcept {
  return state_->sent;
}
std::uint64_t UdpSender::unsent() const noexcept {
  return state_->unsent;
}

}  // namespace pago
