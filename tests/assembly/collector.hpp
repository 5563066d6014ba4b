// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "pago/assembly/sweep_exchange.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "support/catch.hpp"

namespace pago::test {

/// Every return has a cell of its own, and there is nothing else in the range image. `has_echoes`: all but
/// those that came with a stronger one.
inline void require_one_cell_per_return(const Sweep& sweep, bool has_echoes = false) {
  const int columns = static_cast<int>(sweep.header.num_columns);
  REQUIRE(columns <= kMaxColumns);
  std::uint32_t misplaced = 0, taken = 0, expected = 0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (has_echoes && (sweep.echo[i] & kNotStrongest) != 0) continue;
    ++expected;
    const bool inside = sweep.ring[i] < kNumRings && sweep.column[i] < columns;
    if (!inside || sweep.range_image.at(sweep.ring[i], sweep.column[i]) != static_cast<std::int32_t>(i))
      ++misplaced;
  }
  for (int ring = 0; ring < kNumRings; ++ring)
    for (int column = -kColumnMargin; column < kMaxColumns + kColumnMargin; ++column)
      taken += sweep.range_image.at(ring, column) != RangeImage::kEmpty ? 1U : 0U;
  REQUIRE(misplaced == 0);
  REQUIRE(taken == expected);
}

/// FNV-1a over everything the assembler writes except arrival times.
inline std::uint64_t digest(const Sweep& sweep) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  const auto mix = [&hash](const void* data, std::size_t bytes) {
    const auto* byte = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < bytes; ++i) hash = (hash ^ byte[i]) * 0x100000001b3U;
  };
  const auto mix_array = [&](const auto& array) { mix(array.data(), sweep.size * sizeof array[0]); };
  const SweepHeader& h = sweep.header;
  for (const std::uint64_t value :
       {h.sequence, static_cast<std::uint64_t>(h.start_ns), static_cast<std::uint64_t>(h.end_ns),
        std::uint64_t{h.num_columns}, std::uint64_t{h.firings_received}, std::uint64_t{h.firings_lost},
        std::uint64_t{h.packets_bad}, std::uint64_t{h.flags}})
    mix(&value, sizeof value);
  mix_array(sweep.x_m), mix_array(sweep.y_m), mix_array(sweep.z_m), mix_array(sweep.intensity);
  mix_array(sweep.ring), mix_array(sweep.column), mix_array(sweep.time_offset_ns);
  return hash;
}

/// Takes what the assembler hands on, checks what must hold of every sweep, keeps the headers, and frees the
/// sweep at once (or never, to starve the assembler).
class Collector final : public SweepExchange {
 public:
  struct Taken {
    SweepHeader header;
    std::uint32_t size = 0;
    std::uint64_t digest = 0;
  };

  explicit Collector(std::size_t ring_size = 3, std::uint32_t max_returns = kMaxColumns * kNumRings)
      : ring_(ring_size, max_returns) {}

  Sweep* acquire() noexcept override { return ring_.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    parts.push_back(part);
    if (on_part) on_part(part);
    if (!part.last) return;
    const Sweep& sweep = *part.sweep;
    require_one_cell_per_return(sweep, allows_echoes);
    REQUIRE(part.returns_until == sweep.size);
    REQUIRE(part.columns_until == sweep.header.num_columns);
    sweeps.push_back({sweep.header, sweep.size, with_digest ? digest(sweep) : 0});
    if (frees_at_once) ring_.release(&sweep);
  }

  std::uint32_t lost() const {
    std::uint32_t sum = 0;
    for (const Taken& taken : sweeps) sum += taken.header.firings_lost;
    return sum;
  }
  std::uint32_t received() const {
    std::uint32_t sum = 0;
    for (const Taken& taken : sweeps) sum += taken.header.firings_received;
    return sum;
  }
  SweepRing& ring() { return ring_; }

  std::vector<Taken> sweeps;
  std::vector<SweepPart> parts;
  std::function<void(const SweepPart&)> on_part;
  bool frees_at_once = true, with_digest = false, allows_echoes = false;

 private:
  SweepRing ring_;
};

}  // namespace pago::test
