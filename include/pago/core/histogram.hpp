// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace pago {

/// Distribution of durations in fixed memory (8.3 KiB): exact below 32 ns, then 32 buckets for each power of
/// two, up to 2^37 ns (137 s); longer ones share the last bucket. The idea is HdrHistogram's.
///
/// count, min, max and mean are exact; a percentile is never below the true one and at most 1/32 (3.1 %)
/// above it, so a gate on a percentile never passes by rounding.
///
/// Not synchronised: one thread records; another may read a copy made by that thread, or afterwards.
class LatencyHistogram {
 public:
  static constexpr int kRangeBits = 37;

  /// [any thread, one at a time] Real-time safe, about 3 ns. Durations below 0 count as 0 (a clock that was
  /// set back).
  void record(std::int64_t duration_ns) noexcept {
    const std::int64_t ns = std::max<std::int64_t>(0, duration_ns);
    ++buckets_[bucket_of(ns)];
    ++count_;
    sum_ns_ += static_cast<std::uint64_t>(ns);
    min_ns_ = std::min(min_ns_, ns);
    max_ns_ = std::max(max_ns_, ns);
  }

  /// Adds what another histogram has seen.
  void merge(const LatencyHistogram& other) noexcept;
  void clear() noexcept { *this = {}; }

  /// Nearest rank: the least duration that at least `p` percent of all did not exceed; p in [0, 100], clamped
  /// to it. 0 gives min(), 100 gives max(). 0 when nothing was recorded.
  std::int64_t percentile(double p) const noexcept;

  std::uint64_t count() const noexcept { return count_; }
  std::int64_t min() const noexcept { return count_ == 0 ? 0 : min_ns_; }
  std::int64_t max() const noexcept { return max_ns_; }
  double mean() const noexcept;

  // --- for those who draw it (output/): bucket i holds durations in [lower_bound(i), lower_bound(i + 1))
  static constexpr std::size_t num_buckets() noexcept { return kNumBuckets; }
  static constexpr std::int64_t lower_bound(std::size_t bucket) noexcept {
    const int shift = bucket < 2 * kSubBuckets ? 0 : static_cast<int>(bucket / kSubBuckets) - 1;
    return static_cast<std::int64_t>(bucket - static_cast<std::size_t>(shift) * kSubBuckets) << shift;
  }
  std::uint64_t bucket_count(std::size_t bucket) const noexcept { return buckets_[bucket]; }

 private:
  static constexpr int kSubBits = 5;
  static constexpr std::size_t kSubBuckets = std::size_t{1} << kSubBits;
  // [0, 32) one by one, then 32 for each of the powers 5 ... 36.
  static constexpr std::size_t kNumBuckets = kSubBuckets * (1 + kRangeBits - kSubBits);

  /// Keeps a value's six leading bits: they are in [32, 64), and the shift that left them picks the group.
  static constexpr std::size_t bucket_of(std::int64_t ns) noexcept {
    const auto value = std::min(static_cast<std::uint64_t>(ns), (std::uint64_t{1} << kRangeBits) - 1);
    const int shift = std::max(0, static_cast<int>(std::bit_width(value)) - kSubBits - 1);
    return static_cast<std::size_t>(shift) * kSubBuckets + (value >> shift);
  }

  std::array<std::uint64_t, kNumBuckets> buckets_{};
  std::uint64_t count_ = 0;
  std::uint64_t sum_ns_ = 0;  // 584 years
  std::int64_t min_ns_ = INT64_MAX;
  std::int64_t max_ns_ = 0;
};

}  // namespace pago
