// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/histogram.hpp"

#include <cmath>

namespace pago {

namespace {

/// 1-based rank of the percentile among `count` > 0 sorted values. The small subtrahend keeps 99.9 % of 1,000
/// at rank 999, although 99.9 has no exact binary form.
std::uint64_t nearest_rank(double p, std::uint64_t count) noexcept {
  const double share = std::clamp(p, 0.0, 100.0) / 100.0;
  const double rank = std::ceil(share * static_cast<double>(count) - 1e-6);
  return std::clamp<std::uint64_t>(static_cast<std::uint64_t>(std::max(1.0, rank)), 1, count);
}

}  // namespace

void LatencyHistogram::merge(const LatencyHistogram& other) noexcept {
  for (std::size_t i = 0; i < kNumBuckets; ++i) buckets_[i] += other.buckets_[i];
  count_ += other.count_;
  sum_ns_ += other.sum_ns_;
  min_ns_ = std::min(min_ns_, other.min_ns_);
  max_ns_ = std::max(max_ns_, other.max_ns_);
}

std::int64_t LatencyHistogram::percentile(double p) const noexcept {
  if (count_ == 0) return 0;
  if (p <= 0.0) return min_ns_;
  std::uint64_t below = nearest_rank(p, count_);
  std::size_t bucket = 0;
  while (bucket + 1 < kNumBuckets && below > buckets_[bucket]) below -= buckets_[bucket++];
  const bool last = bucket + 1 == kNumBuckets;
  return last ? max_ns_ : std::clamp(lower_bound(bucket + 1) - 1, min_ns_, max_ns_);
}

double LatencyHistogram::mean() const noexcept {
  return count_ == 0 ? 0.0 : static_cast<double>(sum_ns_) / static_cast<double>(count_);
}

}  // namespace pago
