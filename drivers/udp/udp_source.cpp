// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/udp/udp_source.hpp"

#include <netinet/in.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <system_error>

#include "pago/config/packet_filter.hpp"
#include "pago/core/text.hpp"
#include "socket.hpp"

namespace pago {

namespace {

constexpr std::int64_t kNsPerSecond = 1'000'000'000;

std::int64_t ns_of(const timespec& time) noexcept {
  return time.tv_sec * kNsPerSecond + time.tv_nsec;
}

std::int64_t now_ns(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return ns_of(now);
}

/// One datagram's place: payload, sender, and room for what the kernel tells of it.
struct Slot {
  std::array<std::uint8_t, UdpSource::kMaxPayloadBytes> payload;
  sockaddr_in sender;
  alignas(cmsghdr) std::array<std::uint8_t, 128> control;
  iovec vector;
};

/// What the kernel tells of a datagram beside its bytes.
struct Notes {
  std::int64_t arrival_ns = 0;  // 0: it did not say
  bool has_overflow = false;
  std::uint32_t overflow = 0;  // datagrams that this socket has dropped so far, modulo 2^32
};

Notes read_notes(msghdr& header) noexcept {
  Notes notes;
  for (cmsghdr* c = CMSG_FIRSTHDR(&header); c != nullptr; c = CMSG_NXTHDR(&header, c)) {
    if (c->cmsg_level != SOL_SOCKET) continue;
    if (c->cmsg_type == SCM_TIMESTAMPNS) {
      timespec stamp{};
      std::memcpy(&stamp, CMSG_DATA(c), sizeof stamp);
      notes.arrival_ns = ns_of(stamp);
    } else if (c->cmsg_type == SO_RXQ_OVFL) {
      std::memcpy(&notes.overflow, CMSG_DATA(c), sizeof notes.overflow);
      notes.has_overflow = true;
    }
  }
  return notes;
}

/// Errors after which the socket will not come back; all others (no memory just now) pass.
bool is_fatal(int error) noexcept {
  return error == EBADF || error == ENOTSOCK || error == EINVAL || error == EFAULT;
}

}  // namespace

struct UdpSource::State {
  State(const UdpEndpoint& where, const PacketFilterConfig& filter_config, const UdpConfig& udp_config)
      : endpoint(where),
        config(udp_config),
        filter(PacketFilter::of(filter_config)),
        socket(udp::open_receiver(where)),
        granted_bytes(udp::ask_receive_buffer(socket.get(), udp_config.receive_buffer_bytes)),
        interval_ns(static_cast<std::int64_t>(udp_config.drain_interval_ms * 1e6)),
        slots(kBatch) {
    endpoint.port = udp::bound_port(socket.get());
    filter.port = 0;  // the socket has one port and gets no others' datagrams
    for (std::size_t i = 0; i < kBatch; ++i) slots[i].vector = {slots[i].payload.data(), kMaxPayloadBytes};
  }

  void sleep_until_drain() noexcept;
  int receive() noexcept;
  void take(std::size_t i) noexcept;

  UdpEndpoint endpoint;
  UdpConfig config;
  PacketFilter filter;
  udp::Descriptor socket;
  int granted_bytes;
  std::int64_t interval_ns, next_drain_ns = 0;
  bool is_drained = true;

  std::vector<Slot> slots;
  std::array<mmsghdr, kBatch> messages{};
  std::array<Datagram, kBatch> batch{};
  std::size_t batch_size = 0;
  std::uint32_t last_overflow = 0;
  SourceCounters counters;
  int fatal_error = 0;
};

/// Absolute times, so that the work in between does not stretch the interval; after a stall it begins anew.
void UdpSource::State::sleep_until_drain() noexcept {
  const std::int64_t now = now_ns(CLOCK_MONOTONIC);
  next_drain_ns += interval_ns;
  if (next_drain_ns < now || next_drain_ns > now + interval_ns) next_drain_ns = now + interval_ns;
  const timespec until{.tv_sec = next_drain_ns / kNsPerSecond, .tv_nsec = next_drain_ns % kNsPerSecond};
  clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr);
}

int UdpSource::State::receive() noexcept {
  for (std::size_t i = 0; i < kBatch; ++i) {
    msghdr& header = messages[i].msg_hdr;
    header = {};
    header.msg_name = &slots[i].sender;
    header.msg_namelen = sizeof slots[i].sender;
    header.msg_iov = &slots[i].vector;
    header.msg_iovlen = 1;
    header.msg_control = slots[i].control.data();
    header.msg_controllen = slots[i].control.size();
  }
  const int count = recvmmsg(socket.get(), messages.data(), kBatch, MSG_DONTWAIT, nullptr);
  if (count < 0 && is_fatal(errno)) fatal_error = errno;
  return count;
}

void UdpSource::State::take(std::size_t i) noexcept {
  msghdr& header = messages[i].msg_hdr;
  const Notes notes = read_notes(header);
  if (notes.has_overflow) {
    counters.kernel_dropped += notes.overflow - last_overflow;  // unsigned: right across the wrap
    last_overflow = notes.overflow;
  }
  ++counters.received;
  const std::uint32_t sender = ntohl(slots[i].sender.sin_addr.s_addr);
  if (!filter.takes_sender(sender)) {
    ++counters.filtered;
  } else if ((header.msg_flags & MSG_TRUNC) != 0) {
    ++counters.truncated;
  } else {
    ++counters.delivered;
    batch[batch_size++] = {.payload = {slots[i].payload.data(), messages[i].msg_len},
                           .arrival_ns = notes.arrival_ns != 0 ? notes.arrival_ns : now_ns(CLOCK_REALTIME),
                           .source_ipv4 = sender,
                           .source_port = ntohs(slots[i].sender.sin_port),
                           .destination_port = static_cast<std::uint16_t>(endpoint.port)};
  }
}

UdpSource::UdpSource(const UdpEndpoint& endpoint, const PacketFilterConfig& filter, const UdpConfig& config)
    : state_(std::make_unique<State>(endpoint, filter, config)) {}
UdpSource::~UdpSource() = default;

std::span<const Datagram> UdpSource::receive() noexcept {
  State& s = *state_;
  s.batch_size = 0;
  if (s.is_drained) s.sleep_until_drain();
  const int count = s.receive();
  s.is_drained = count < static_cast<int>(kBatch);
  for (int i = 0; i < count; ++i) s.take(static_cast<std::size_t>(i));
  return {s.batch.data(), s.batch_size};
}

bool UdpSource::all_done() const noexcept {
  return state_->fatal_error != 0;
}
SourceCounters UdpSource::counters() const noexcept {
  return state_->counters;
}
std::string UdpSource::complaint() const {
  if (state_->fatal_error == 0) return {};
  return to_string(state_->endpoint) +
         ": the socket failed: " + std::generic_category().message(state_->fatal_error);
}
int UdpSource::port() const noexcept {
  return state_->endpoint.port;
}
int UdpSource::receive_buffer_bytes() const noexcept {
  return state_->granted_bytes;
}

std::vector<std::string> UdpSource::warnings() const {
  // The kernel doubles what is asked, for its own bookkeeping (socket(7)).
  const int asked = state_->config.receive_buffer_bytes, granted = state_->granted_bytes / 2;
  if (granted >= asked) return {};
  constexpr double kBytesPerDatagram = 2304.0, kDatagramsPerSecond = 3472.0;
  return {format(
      "the kernel granted a receive buffer of %d bytes instead of %d: it holds %.0f ms of an "
      "HDL-64E, and packets are lost when the host is busy for longer (as root: sysctl -w "
      "net.core.rmem_max=%d)",
      granted, asked, 1000.0 * state_->granted_bytes / kBytesPerDatagram / kDatagramsPerSecond, asked)};
}

}  // namespace pago
