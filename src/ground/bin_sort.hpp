// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "level.hpp"
#include "points.hpp"

namespace pago::ground {

/// The returns of a sweep sorted into bins by counting: contiguous in each bin, in the sweep's order. A bin
/// may be sorted before the sweep is complete; what comes out does not depend on when. [front thread]
/// everything but the constructor; real-time safe.
class BinSort {
 public:
  static constexpr int kMaxBins = 65534;

  /// [set-up] For up to kMaxBins; allocates.
  BinSort(int num_bins, std::uint32_t max_returns);

  int num_bins() const noexcept { return static_cast<int>(num_bins_); }

  /// For a new sweep.
  void begin() noexcept;

  /// Where the bin of each return is to be written; num_bins() = none.
  std::uint16_t* bin_of() noexcept { return bin_of_.data(); }
  const std::uint16_t* bin_of() const noexcept { return bin_of_.data(); }

  /// Takes note of returns [noted(), until), whose bins are written.
  void note(std::uint32_t until) noexcept;
  std::uint32_t noted() const noexcept { return noted_; }

  /// Puts the returns of these bins into place, in the belief that no more will come.
  void sort(const Coordinates& returns, std::span<const std::uint16_t> bins) noexcept;

  /// Puts the rest into place. If a return has come for a bin that was sorted before, everything is sorted
  /// anew.
  void sort_rest(const Coordinates& returns) noexcept;

  /// Whether sort() has been given this bin.
  bool is_sorted(int bin) const noexcept { return state_[static_cast<std::size_t>(bin)] != State::kOpen; }
  /// Whether the last call of sort() or sort_rest() has put this bin into place.
  bool is_fresh(int bin) const noexcept { return state_[static_cast<std::size_t>(bin)] == State::kFresh; }

  /// The returns of a bin that is sorted.
  Points points(int bin) const noexcept { return points(bin, bin + 1); }
  /// Those of bins [from, until), where all bins were sorted at once.
  Points points(int from, int until) const noexcept;

 private:
  // Returns that were noted in one go are counted and moved as four streams, a quarter each: what goes to the
  // same bin in turns would wait for its own count to be stored.
  static constexpr std::size_t kStreams = 4;
  enum class State : std::uint8_t { kOpen, kFresh, kSorted };
  using PerStream = std::array<std::uint32_t, kStreams>;
  struct Extent {
    std::uint32_t begin, size;
  };
  // x, y, z, nothing: a return is moved with one store, into one cache line.
  using Place = float __attribute__((vector_size(16)));

  void reopen() noexcept;
  void make_room(std::size_t bin) noexcept;
  void put(const Coordinates& returns, std::uint32_t i, std::size_t stream) noexcept;
  void move_waiting(const Coordinates& returns) noexcept;
  void move_streams(const Coordinates& returns) noexcept;
  void split_places(std::uint32_t size) noexcept;

  std::size_t num_bins_;
  std::uint32_t noted_ = 0;
  bool is_in_one_go_ = true;
  bool is_late_ = false;         // a return has come for a bin that was sorted before
  std::uint32_t looked_at_ = 0;  // returns before it are in place, in no bin, or waiting
  std::uint32_t num_waiting_ = 0;
  std::uint32_t used_ = 0;  // places
  AlignedArray<std::uint16_t> bin_of_;
  AlignedArray<std::uint32_t> waiting_;
  // Per bin, and one for the returns outside.
  AlignedArray<State> state_;
  AlignedArray<PerStream> count_;  // all in the first stream's, if noted bit by bit
  AlignedArray<PerStream> next_;   // where the next return goes
  AlignedArray<Extent> extent_;
  AlignedArray<Place> place_;
  AlignedArray<float> x_m_, y_m_, z_m_;
};

}  // namespace pago::ground
