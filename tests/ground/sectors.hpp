// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "tests/ground/cases.hpp"

namespace pago::test {

/// The part of a finished sweep that would have arrived when `share` of its columns were closed.
inline SweepPart part_of(Sweep& sweep, double share) {
  const auto columns = static_cast<std::uint32_t>(share * sweep.header.num_columns);
  std::uint32_t until = 0;
  while (until < sweep.size && sweep.column[until] < columns) ++until;
  return {&sweep, until, columns, false};
}

/// Segments sweeps while their parts come, with every method, and holds each mask against the whole sweep's.
class SectorWatch {
 public:
  explicit SectorWatch(const Mount& mount, std::uint32_t max_returns = 300'000)
      : SectorWatch(ground_cases(), mount, max_returns) {}
  SectorWatch(const std::vector<GroundCase>& cases, const Mount& mount, std::uint32_t max_returns = 300'000) {
    for (const GroundCase& c : cases)
      pairs_.push_back({c.name,
                        ground::make_segmenter(c.config, mount, max_returns),
                        ground::make_segmenter(c.config, mount, max_returns),
                        AlignedArray<std::uint8_t>(max_returns),
                        {}});
  }

  void take(const SweepPart& part) {
    ++parts_;
    Sweep& sweep = *part.sweep;
    for (Pair& pair : pairs_) {
      std::swap(sweep.ground, pair.mask);  // methods may write while the sweep arrives: each to its own
      if (!is_open_) pair.in_sectors->begin(sweep);
      pair.in_sectors->accept(part);
      if (part.last) pair.in_sectors->finish(sweep);
      std::swap(sweep.ground, pair.mask);
    }
    is_open_ = !part.last;
    if (!part.last) return;
    for (Pair& pair : pairs_) compare(pair, sweep);
    ++sweeps_;
    ++round_sweeps_;
  }

  /// From here on the sweeps begin with the same one again and again, by begin_anew(): what they give as
  /// whole ones is kept after the first time.
  void repeat() { is_repeated_ = true; }
  void begin_anew() {
    round_sweeps_ = 0;
    for (Pair& pair : pairs_) pair.in_sectors->reset();
  }

  int sweeps() const { return sweeps_; }
  int parts() const { return parts_; }
  /// Returns whose mask was another one, of all methods together.
  long different() const {
    long sum = 0;
    for (const Pair& pair : pairs_) sum += pair.different;
    return sum;
  }
  /// Which methods differed, and in how many returns.
  std::string complaint() const {
    std::string text;
    for (const Pair& pair : pairs_)
      if (pair.different > 0) text += pair.name + " differs in " + std::to_string(pair.different) + "; ";
    return text;
  }

 private:
  struct Pair {
    std::string name;
    std::unique_ptr<ground::Segmenter> in_sectors, whole;
    AlignedArray<std::uint8_t> mask;
    std::vector<std::vector<std::uint8_t>> kept;  // of whole sweeps
    long different = 0;
  };

  void compare(Pair& pair, Sweep& sweep) const {
    if (!is_repeated_ || round_sweeps_ == pair.kept.size()) segment(*pair.whole, sweep);
    if (is_repeated_ && round_sweeps_ == pair.kept.size()) pair.kept.push_back(mask_of(sweep));
    const std::uint8_t* const whole = is_repeated_ ? pair.kept[round_sweeps_].data() : sweep.ground.data();
    for (std::uint32_t i = 0; i < sweep.size; ++i) pair.different += pair.mask[i] != whole[i] ? 1 : 0;
  }

  std::vector<Pair> pairs_;
  bool is_open_ = false, is_repeated_ = false;
  std::size_t round_sweeps_ = 0;
  int sweeps_ = 0, parts_ = 0;
};

}  // namespace pago::test
