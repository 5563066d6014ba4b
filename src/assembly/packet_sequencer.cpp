// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/packet_sequencer.hpp"

#include <algorithm>
#include <cassert>

namespace pago {

void PacketCopy::take(const StampedPacket& packet) noexcept {
  std::copy(packet.bytes.begin(), packet.bytes.end(), bytes.begin());
  time_ns = packet.time_ns;
  arrival_ns = packet.arrival_ns;
}

PacketSequencer::PacketSequencer(int window)
    : window_(static_cast<std::size_t>(window)), slots_(window_ + 1) {}

void PacketSequencer::set_format(const hdl64::StreamFormat& format) noexcept {
  packet_period_ns_ = format.packet_period_ns();
  firings_per_packet_ = static_cast<std::uint64_t>(format.firings());
}

PacketSequencer::Verdict PacketSequencer::offer(const StampedPacket& packet) noexcept {
  const Identity identity = identify(packet);
  const std::int64_t periods = started_ ? periods_after_last(packet.time_ns) : 1;
  if (periods <= 0) return is_known(identity) ? Verdict::kDuplicate : Verdict::kLate;
  if (periods == 1) {
    if (held_ > 0) ++reordered_;
    emit(identity);
    return Verdict::kNext;
  }
  if (held_ > 0 && is_known(identity)) return Verdict::kDuplicate;
  const auto free = std::find_if(slots_.begin(), slots_.end(), [](const Slot& s) { return !s.is_used; });
  assert(free != slots_.end());
  free->copy.take(packet);
  free->is_used = true;
  ++held_;
  return Verdict::kHeld;
}

std::optional<StampedPacket> PacketSequencer::take() noexcept {
  if (held_ == 0) return std::nullopt;
  const std::size_t slot = oldest();
  if (held_ <= window_ && periods_after_last(slots_[slot].copy.time_ns) > 1) return std::nullopt;
  return take_slot(slot);
}

std::optional<StampedPacket> PacketSequencer::take_regardless() noexcept {
  if (held_ == 0) return std::nullopt;
  return take_slot(oldest());
}

void PacketSequencer::restart() noexcept {
  assert(held_ == 0);
  started_ = false;
  recent_ = {};
}

void PacketSequencer::excuse(std::uint64_t firings) noexcept {
  firings_.lost -= firings;
  firings_.blind += firings;
}

std::int64_t PacketSequencer::periods_after_last(std::int64_t time_ns) const noexcept {
  const std::int64_t passed_ns = time_ns - last_ns_ + packet_period_ns_ / 2;
  if (passed_ns >= packet_period_ns_ && passed_ns < 2 * packet_period_ns_) return 1;  // spares the division
  return passed_ns < 0 ? 0 : passed_ns / packet_period_ns_;
}

bool PacketSequencer::is_known(const Identity& packet) const noexcept {
  if (std::find(recent_.begin(), recent_.end(), packet) != recent_.end()) return true;
  return std::any_of(slots_.begin(), slots_.end(),
                     [&](const Slot& s) { return s.is_used && identify(s.copy.packet()) == packet; });
}

void PacketSequencer::emit(const Identity& packet) noexcept {
  // Held packets may lie closer together than a period where a stamp is damaged: each counts as one.
  periods_on_ = started_ ? std::max<std::int64_t>(1, periods_after_last(packet.time_ns)) : 1;
  const auto periods = static_cast<std::uint64_t>(periods_on_);
  firings_.expected += periods * firings_per_packet_;
  firings_.lost += (periods - 1) * firings_per_packet_;
  firings_.decoded += firings_per_packet_;
  started_ = true;
  last_ns_ = packet.time_ns;
  recent_[next_recent_] = packet;
  next_recent_ = (next_recent_ + 1) % recent_.size();
}

std::size_t PacketSequencer::oldest() const noexcept {
  std::size_t best = slots_.size();
  for (std::size_t slot = 0; slot < slots_.size(); ++slot)
    if (slots_[slot].is_used &&
        (best == slots_.size() || slots_[slot].copy.time_ns < slots_[best].copy.time_ns))
      best = slot;
  return best;
}

std::optional<StampedPacket> PacketSequencer::take_slot(std::size_t slot) noexcept {
  slots_[slot].is_used = false;
  --held_;
  const StampedPacket packet = slots_[slot].copy.packet();
  emit(identify(packet));
  return packet;
}

}  // namespace pago
