// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "bin_sort.hpp"

#include <algorithm>
#include <cassert>

#include "pago/core/prefetch.hpp"

namespace pago::ground {

BinSort::BinSort(int num_bins, std::uint32_t max_returns)
    : num_bins_(static_cast<std::size_t>(num_bins)),
      bin_of_(max_returns),
      waiting_(max_returns),
      state_(num_bins_ + 1),
      count_(num_bins_ + 1),
      next_(num_bins_ + 1),
      extent_(num_bins_ + 1),
      place_(max_returns),
      x_m_(max_returns),
      y_m_(max_returns),
      z_m_(max_returns) {
  assert(num_bins > 0 && num_bins <= kMaxBins);
}

void BinSort::begin() noexcept {
  noted_ = 0;
  is_in_one_go_ = true;
  std::fill(count_.begin(), count_.end(), PerStream{});
  reopen();
}

void BinSort::reopen() noexcept {
  std::fill(state_.begin(), state_.end(), State::kOpen);
  is_late_ = false;
  looked_at_ = num_waiting_ = used_ = 0;
}

void BinSort::note(std::uint32_t until) noexcept {
  if (until <= noted_) return;
  is_in_one_go_ = noted_ == 0;
  const std::uint16_t* const bin_of = bin_of_.data();
  if (!is_in_one_go_) {
    for (; noted_ < until; ++noted_) {
      ++count_[bin_of[noted_]][0];
      is_late_ |= state_[bin_of[noted_]] != State::kOpen;
    }
    return;
  }
  const std::uint32_t quarter = static_cast<std::uint32_t>(until / kStreams);
  for (std::uint32_t i = 0; i < quarter; ++i)
    for (std::uint32_t stream = 0; stream < kStreams; ++stream)
      ++count_[bin_of[stream * quarter + i]][stream];
  for (std::uint32_t i = kStreams * quarter; i < until; ++i) ++count_[bin_of[i]][kStreams - 1];
  noted_ = until;
}

void BinSort::make_room(std::size_t bin) noexcept {
  const std::uint32_t begin = used_;
  for (std::size_t stream = 0; stream < kStreams; ++stream) {
    next_[bin][stream] = used_;
    used_ += count_[bin][stream];
  }
  extent_[bin] = {begin, used_ - begin};
}

void BinSort::sort(const Coordinates& returns, std::span<const std::uint16_t> bins) noexcept {
  for (State& state : state_) state = state == State::kFresh ? State::kSorted : state;
  for (const std::uint16_t bin : bins) {
    make_room(bin);
    state_[bin] = State::kFresh;
  }
  move_waiting(returns);
}

void BinSort::sort_rest(const Coordinates& returns) noexcept {
  if (is_late_) reopen();
  const bool is_all = used_ == 0 && looked_at_ == 0;
  for (std::size_t bin = 0; bin < num_bins_; ++bin) {
    const bool is_open = state_[bin] == State::kOpen;
    if (is_open) make_room(bin);
    state_[bin] = is_open ? State::kFresh : State::kSorted;
  }
  if (is_all && is_in_one_go_) {
    make_room(num_bins_);  // returns in no bin are put behind: sparing them would cost a branch
    move_streams(returns);
  } else {
    move_waiting(returns);
  }
}

void BinSort::put(const Coordinates& returns, std::uint32_t i, std::size_t stream) noexcept {
  const std::uint32_t to = next_[bin_of_[i]][stream]++;
  x_m_[to] = returns.x_m[i];
  y_m_[to] = returns.y_m[i];
  z_m_[to] = returns.z_m[i];
}

/// Returns of fresh bins; those of open bins wait on.
void BinSort::move_waiting(const Coordinates& returns) noexcept {
  std::uint32_t still_waiting = 0;
  const auto look_at = [&](std::uint32_t i) {
    const std::size_t bin = bin_of_[i];
    if (state_[bin] == State::kFresh) {
      put(returns, i, 0);  // the places of the other streams follow
    } else if (bin != num_bins_) {
      waiting_[still_waiting++] = i;
    }
  };
  for (std::uint32_t k = 0; k < num_waiting_; ++k) look_at(waiting_[k]);
  for (; looked_at_ < noted_; ++looked_at_) look_at(looked_at_);
  num_waiting_ = still_waiting;
}

/// A bin's next cache line is fetched while this one is filled: waiting for it took half of the time.
void BinSort::move_streams(const Coordinates& returns) noexcept {
  // Pointers of its own: the compiler cannot know that no store changes a member.
  const float* const from_x = returns.x_m;
  const float* const from_y = returns.y_m;
  const float* const from_z = returns.z_m;
  Place* const place = place_.data();
  const std::uint16_t* const bin_of = bin_of_.data();
  PerStream* const next = next_.data();
  constexpr std::ptrdiff_t kPlacesAhead = kCacheLineBytes / sizeof(Place) + 2;
  const std::uint32_t quarter = static_cast<std::uint32_t>(noted_ / kStreams);
  const auto put = [=](std::uint32_t i, std::size_t stream) {
    Place* const to = place + next[bin_of[i]][stream]++;
    prefetch_to_write(to + kPlacesAhead);
    *to = Place{from_x[i], from_y[i], from_z[i], 0.0F};
  };
  for (std::uint32_t i = 0; i < quarter; ++i) {
    put(i, 0);
    put(i + quarter, 1);
    put(i + 2 * quarter, 2);
    put(i + 3 * quarter, 3);
  }
  for (std::uint32_t i = kStreams * quarter; i < noted_; ++i) put(i, kStreams - 1);
  looked_at_ = noted_;
  split_places(extent_[num_bins_].begin);
}

void BinSort::split_places(std::uint32_t size) noexcept {
  const Place* const place = place_.data();
  float* const x = x_m_.data();
  float* const y = y_m_.data();
  float* const z = z_m_.data();
#pragma omp simd
  for (std::uint32_t i = 0; i < size; ++i) {
    x[i] = place[i][0];
    y[i] = place[i][1];
    z[i] = place[i][2];
  }
}

Points BinSort::points(int from, int until) const noexcept {
  const Extent& last = extent_[static_cast<std::size_t>(until) - 1];
  const std::size_t begin = extent_[static_cast<std::size_t>(from)].begin;
  const std::size_t size = last.begin + last.size - begin;
  return {{x_m_.data() + begin, size}, {y_m_.data() + begin, size}, {z_m_.data() + begin, size}};
}

}  // namespace pago::ground
