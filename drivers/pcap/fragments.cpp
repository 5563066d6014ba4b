// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "fragments.hpp"

#include <algorithm>

namespace pago::pcap {

FragmentTable::FragmentTable(std::size_t max_bytes) : max_bytes_(max_bytes), bytes_(kSlots * max_bytes) {}

Bytes FragmentTable::add(const Frame& piece, std::int64_t stamp_ns, SourceCounters& counters) noexcept {
  const std::size_t index = slot_for(piece.key, stamp_ns, counters);
  Slot& slot = slots_[index];
  switch (cover(slot, piece)) {
    case Fit::kRepeated:
      return {};
    case Fit::kContradiction:
      slot.in_use = false;
      ++counters.received;
      ++counters.malformed;
      return {};
    case Fit::kNew:
      break;
  }
  store(index, piece);
  if (slot.length == 0 || slot.covered < (slot.length + kUnitBytes - 1) / kUnitBytes) return {};
  if (slot.is_cut) {
    give_up(slot, counters);
    return {};
  }
  slot.in_use = false;
  return bytes_.first(bytes_.size()).subspan(index * max_bytes_, slot.length);
}

void FragmentTable::finish(SourceCounters& counters) noexcept {
  for (Slot& slot : slots_)
    if (slot.in_use) give_up(slot, counters);
}

std::size_t FragmentTable::slot_for(const FragmentKey& key,
                                    std::int64_t stamp_ns,
                                    SourceCounters& counters) noexcept {
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < kSlots; ++i) {
    Slot& slot = slots_[i];
    if (slot.in_use && slot.key == key) {
      // Captures may step back in time; subtracting as unsigned cannot overflow on absurd stamps.
      const auto age = static_cast<std::uint64_t>(stamp_ns) - static_cast<std::uint64_t>(slot.first_stamp_ns);
      const bool is_sibling = age + kMaxAgeNs <= 2 * static_cast<std::uint64_t>(kMaxAgeNs);
      if (is_sibling) return i;
      give_up(slot, counters);
    }
    const Slot& best = slots_[chosen];
    if (best.in_use && (!slot.in_use || slot.order < best.order)) chosen = i;
  }
  Slot& slot = slots_[chosen];
  if (slot.in_use) give_up(slot, counters);
  slot.in_use = true;
  slot.is_cut = false;
  slot.key = key;
  slot.first_stamp_ns = stamp_ns;
  slot.order = next_order_++;
  slot.length = slot.end = 0;
  slot.covered = 0;
  slot.units.reset();
  return chosen;
}

FragmentTable::Fit FragmentTable::cover(Slot& slot, const Frame& piece) noexcept {
  const std::uint32_t end = piece.fragment_offset + piece.fragment_length;
  const std::size_t first = piece.fragment_offset / kUnitBytes;
  const std::size_t last = (end + kUnitBytes - 1) / kUnitBytes;
  std::size_t known = 0;
  for (std::size_t unit = first; unit < last; ++unit) known += slot.units[unit] ? 1U : 0U;

  const bool ends_agree = piece.more_fragments ? slot.length == 0 || end <= slot.length
                                               : (slot.length == 0 || end == slot.length) && end >= slot.end;
  // Pieces that overlap in part are an attack or a fault, never a sensor (RFC 5722).
  if (!ends_agree || (known != 0 && known != last - first)) return Fit::kContradiction;
  if (known != 0) return Fit::kRepeated;
  for (std::size_t unit = first; unit < last; ++unit) slot.units.set(unit);
  slot.covered += last - first;
  slot.end = std::max(slot.end, end);
  if (!piece.more_fragments) slot.length = end;
  return Fit::kNew;
}

void FragmentTable::store(std::size_t slot, const Frame& piece) noexcept {
  const bool fits = piece.fragment_offset + piece.fragment_length <= max_bytes_;
  if (!fits || piece.payload.size() < piece.fragment_length) {
    slots_[slot].is_cut = true;
    return;
  }
  std::copy(piece.payload.begin(), piece.payload.end(),
            bytes_.begin() + slot * max_bytes_ + piece.fragment_offset);
}

void FragmentTable::give_up(Slot& slot, SourceCounters& counters) noexcept {
  slot.in_use = false;
  ++counters.received;
  ++(slot.is_cut ? counters.truncated : counters.fragment_lost);
}

}  // namespace pago::pcap
