// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>

#include "frame.hpp"
#include "pago/core/aligned_array.hpp"
#include "pago/core/sources.hpp"

namespace pago::pcap {

/// Puts fragmented datagrams together again, whatever the order of the pieces. Bounded: kSlots datagrams at a
/// time; when another one begins, the oldest unfinished one is given up. [set-up] the constructor allocates;
/// [ingest thread] the rest, real-time safe.
class FragmentTable {
 public:
  static constexpr std::size_t kSlots = 32;
  /// A 16-bit id comes round again after 19 s at the sensor's 3,472 datagrams/s: pieces farther apart than
  /// this are strangers, far though siblings may travel in a busy capture.
  static constexpr std::int64_t kMaxAgeNs = 1'000'000'000;

  /// `max_bytes`: the longest datagram kept, UDP header included. Longer ones are tracked, then counted as
  /// truncated.
  explicit FragmentTable(std::size_t max_bytes);

  /// Takes a piece (Frame::Kind::kFragment). Returns the whole datagram, UDP header first, when the piece was
  /// the last one missing, else nothing. It stays valid until the next call. Datagrams that come to another
  /// end are counted in `counters`, as received and as lost, truncated or malformed; whole ones are left to
  /// the caller to count.
  Bytes add(const Frame& piece, std::int64_t stamp_ns, SourceCounters& counters) noexcept;

  /// The capture has ended: everything unfinished is given up.
  void finish(SourceCounters& counters) noexcept;

 private:
  static constexpr std::size_t kUnitBytes = 8;  // fragments begin at multiples of this
  static constexpr std::size_t kUnits = 65536 / kUnitBytes;

  struct Slot {
    bool in_use = false;
    bool is_cut = false;  // part of a piece was not captured, or does not fit
    FragmentKey key;
    std::int64_t first_stamp_ns = 0;
    std::uint64_t order = 0;
    std::uint32_t length = 0;  // of the datagram; 0 until the last piece has come
    std::uint32_t end = 0;     // of the farthest piece so far
    std::size_t covered = 0;   // units received
    std::bitset<kUnits> units;
  };
  enum class Fit : std::uint8_t { kNew, kRepeated, kContradiction };

  std::size_t slot_for(const FragmentKey& key, std::int64_t stamp_ns, SourceCounters& counters) noexcept;
  static Fit cover(Slot& slot, const Frame& piece) noexcept;
  void store(std::size_t slot, const Frame& piece) noexcept;
  static void give_up(Slot& slot, SourceCounters& counters) noexcept;

  std::size_t max_bytes_;
  std::array<Slot, kSlots> slots_;
  AlignedArray<std::uint8_t> bytes_;  // kSlots x max_bytes_
  std::uint64_t next_order_ = 0;
};

}  // namespace pago::pcap
