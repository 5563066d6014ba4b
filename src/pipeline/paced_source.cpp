// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/paced_source.hpp"

#include <algorithm>

#include "pago/platform/clock.hpp"

namespace pago {

PacedSource::PacedSource(PacketSource& recorded, double speed, std::int64_t interval_ns) noexcept
    : recorded_(recorded), speed_(speed), interval_ns_(interval_ns) {}

std::int64_t PacedSource::due_ns(const Datagram& datagram) const noexcept {
  const auto after_ns = static_cast<double>(datagram.arrival_ns - first_arrival_ns_);
  return start_ns_ + static_cast<std::int64_t>(after_ns / speed_);
}

/// False when there is nothing just now.
bool PacedSource::fetch() noexcept {
  if (waiting_.empty() && !recorded_.all_done()) waiting_ = recorded_.receive();
  if (waiting_.empty()) return false;
  if (!has_started_) {
    has_started_ = true;
    first_arrival_ns_ = waiting_.front().arrival_ns;
    start_ns_ = platform::monotonic_ns();
    to_realtime_ns_ = platform::realtime_ns() - start_ns_;
  }
  return true;
}

std::span<const Datagram> PacedSource::receive() noexcept {
  if (!fetch()) return {};
  if (due_ns(waiting_.front()) > platform::monotonic_ns())
    platform::sleep_until_ns(platform::monotonic_ns() + interval_ns_);
  const std::int64_t now_ns = platform::monotonic_ns();
  std::size_t size = 0;
  while (size < batch_.size() && size < waiting_.size() && due_ns(waiting_[size]) <= now_ns) {
    batch_[size] = waiting_[size];
    const std::int64_t due = due_ns(waiting_[size]);
    batch_[size].arrival_ns = due + to_realtime_ns_;
    worst_lateness_ns_ = std::max(worst_lateness_ns_, now_ns - due);
    ++size;
  }
  waiting_ = waiting_.subspan(size);
  return {batch_.data(), size};
}

bool PacedSource::all_done() const noexcept {
  return waiting_.empty() && recorded_.all_done();
}

SourceCounters PacedSource::counters() const noexcept {
  SourceCounters counters = recorded_.counters();
  counters.received -= waiting_.size();
  counters.delivered -= waiting_.size();
  return counters;
}

}  // namespace pago
