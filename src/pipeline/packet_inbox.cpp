// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/packet_inbox.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "pago/core/spsc_queue.hpp"
#include "pago/platform/clock.hpp"

namespace pago {

namespace {

constexpr std::int64_t kInterval_ns = 2'000'000;
constexpr std::size_t kBatch = 64;

struct Submitted {
  std::int64_t arrival_ns = 0;
  std::uint32_t size = 0;
  std::array<std::uint8_t, PacketInbox::kMaxPayloadBytes> payload;
};

}  // namespace

struct PacketInbox::State {
  explicit State(std::uint32_t capacity) : queue(capacity), packets(kBatch) {}

  SpscQueue<Submitted> queue;
  std::atomic<bool> is_closed{false};
  std::atomic<std::uint64_t> dropped{0}, truncated{0};
  std::atomic<bool> is_empty_after_close{false};

  std::vector<Submitted> packets;
  std::array<Datagram, kBatch> batch{};
  std::uint64_t delivered = 0;
};

PacketInbox::PacketInbox(std::uint32_t capacity) : state_(std::make_unique<State>(capacity)) {}
PacketInbox::~PacketInbox() = default;

bool PacketInbox::submit(std::span<const std::uint8_t> payload, std::int64_t arrival_ns) noexcept {
  State& s = *state_;
  if (payload.size() > kMaxPayloadBytes) {
    s.truncated.fetch_add(1, std::memory_order_relaxed);
    return false;
  }
  Submitted packet;
  packet.arrival_ns = arrival_ns;
  packet.size = static_cast<std::uint32_t>(payload.size());
  std::copy(payload.begin(), payload.end(), packet.payload.begin());
  if (s.queue.try_push(packet)) return true;
  s.dropped.fetch_add(1, std::memory_order_relaxed);
  return false;
}

void PacketInbox::close() noexcept {
  // Release, pairs with receive(): who sees the end sees everything that was pushed before it.
  state_->is_closed.store(true, std::memory_order_release);
}

std::span<const Datagram> PacketInbox::receive() noexcept {
  State& s = *state_;
  const bool was_closed = s.is_closed.load(std::memory_order_acquire);
  std::size_t size = 0;
  while (size < kBatch && s.queue.try_pop(s.packets[size])) {
    const Submitted& packet = s.packets[size];
    s.batch[size] = {.payload = std::span(packet.payload).first(packet.size),
                     .arrival_ns = packet.arrival_ns};
    ++size;
  }
  s.delivered += size;
  if (size == 0 && was_closed)
    s.is_empty_after_close.store(true, std::memory_order_relaxed);
  else if (size < kBatch)
    platform::sleep_until_ns(platform::monotonic_ns() + kInterval_ns);
  return {s.batch.data(), size};
}

bool PacketInbox::all_done() const noexcept {
  return state_->is_empty_after_close.load(std::memory_order_relaxed);
}

SourceCounters PacketInbox::counters() const noexcept {
  const State& s = *state_;
  SourceCounters counters;
  counters.delivered = s.delivered;
  counters.truncated = s.truncated.load(std::memory_order_relaxed);
  counters.received = counters.delivered + counters.truncated;
  counters.kernel_dropped = s.dropped.load(std::memory_order_relaxed);
  return counters;
}

}  // namespace pago
