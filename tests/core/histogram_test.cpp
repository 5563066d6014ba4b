// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/histogram.hpp"

#include <cmath>
#include <random>
#include <vector>

#include "support/catch.hpp"

using pago::LatencyHistogram;

namespace {

constexpr double kPercentiles[] = {0.0, 0.1, 1.0, 10.0, 25.0, 50.0, 75.0, 90.0, 99.0, 99.9, 99.99, 100.0};

/// The definition, by counting: the least value that at least p percent of the values do not exceed.
std::int64_t percentile_by_counting(const std::vector<std::int64_t>& sorted, long per_myriad) {
  const long n = static_cast<long>(sorted.size());
  for (long i = 0; i < n; ++i) {
    if ((i + 1) * 10000 >= per_myriad * n) return sorted[static_cast<std::size_t>(i)];
  }
  return sorted.back();
}

void require_same_as_sorted(std::vector<std::int64_t> samples) {
  LatencyHistogram histogram;
  double sum = 0.0;
  for (const auto ns : samples) {
    histogram.record(ns);
    sum += static_cast<double>(ns);
  }
  std::sort(samples.begin(), samples.end());
  REQUIRE(histogram.count() == samples.size());
  REQUIRE(histogram.min() == samples.front());
  REQUIRE(histogram.max() == samples.back());
  REQUIRE(histogram.mean() == Approx(sum / static_cast<double>(samples.size())).epsilon(1e-12));
  for (const double p : kPercentiles) {
    const auto truth = percentile_by_counting(samples, std::lround(p * 100.0));
    INFO("percentile " << p << " of " << samples.size());
    CHECK(histogram.percentile(p) >= truth);
    CHECK(static_cast<double>(histogram.percentile(p)) <= static_cast<double>(truth) * (1.0 + 1.0 / 32.0));
  }
}

}  // namespace

TEST_CASE("percentiles are those of the sorted samples, at most 1/32 above", "[core][histogram]") {
  std::mt19937_64 random(42);
  const auto size = GENERATE(1U, 2U, 3U, 10U, 999U, 1000U, 1001U, 20000U);
  std::vector<std::int64_t> samples(size);

  SECTION("latencies around 10 ms with a long tail") {
    std::lognormal_distribution<double> distribution(std::log(10e6), 1.5);
    for (auto& ns : samples) ns = static_cast<std::int64_t>(distribution(random));
    require_same_as_sorted(samples);
  }
  SECTION("all magnitudes from 1 ns to 100 s") {
    std::uniform_real_distribution<double> exponent(0.0, 11.0);
    for (auto& ns : samples) ns = static_cast<std::int64_t>(std::pow(10.0, exponent(random)));
    require_same_as_sorted(samples);
  }
  SECTION("many equal values") {
    for (auto& ns : samples) ns = random() % 4 == 0 ? 1'000'000 : 2'000'000;
    require_same_as_sorted(samples);
  }
}

TEST_CASE("99.9 percent of a thousand is the 999th, not the 1000th", "[core][histogram]") {
  LatencyHistogram histogram;
  for (int i = 0; i < 999; ++i) histogram.record(10);
  histogram.record(1'000'000);
  CHECK(histogram.percentile(99.9) == 10);
  CHECK(histogram.percentile(99.91) == 1'000'000);
}

TEST_CASE("buckets cover every duration once and are at most 1/32 wide", "[core][histogram]") {
  const std::size_t n = LatencyHistogram::num_buckets();
  REQUIRE(LatencyHistogram::lower_bound(0) == 0);
  REQUIRE(LatencyHistogram::lower_bound(n) == std::int64_t{1} << LatencyHistogram::kRangeBits);
  for (std::size_t i = 0; i < n; ++i) {
    const auto low = LatencyHistogram::lower_bound(i), next = LatencyHistogram::lower_bound(i + 1);
    REQUIRE(next > low);
    REQUIRE((next - low == 1 || (next - low) * 32 <= low));
    LatencyHistogram histogram;
    histogram.record(low);
    histogram.record(next - 1);
    REQUIRE(histogram.bucket_count(i) == 2);
  }
}

TEST_CASE("values outside the range are clamped and still counted", "[core][histogram]") {
  LatencyHistogram histogram;
  histogram.record(-5);
  CHECK(histogram.min() == 0);
  histogram.record(INT64_MAX / 4);
  CHECK(histogram.count() == 2);
  CHECK(histogram.max() == INT64_MAX / 4);
  CHECK(histogram.percentile(100.0) == INT64_MAX / 4);
  CHECK(histogram.percentile(50.0) == 0);
  CHECK(histogram.percentile(-1.0) == 0);
  CHECK(histogram.percentile(1000.0) == INT64_MAX / 4);
}

TEST_CASE("an empty histogram answers zero", "[core][histogram]") {
  const LatencyHistogram histogram;
  CHECK(histogram.count() == 0);
  CHECK(histogram.min() == 0);
  CHECK(histogram.max() == 0);
  CHECK(histogram.mean() == 0.0);
  CHECK(histogram.percentile(50.0) == 0);
}

TEST_CASE("merging two histograms equals recording everything in one", "[core][histogram]") {
  std::mt19937_64 random(7);
  std::lognormal_distribution<double> distribution(std::log(1e6), 2.0);
  LatencyHistogram first, second, both;
  for (int i = 0; i < 5000; ++i) {
    const auto ns = static_cast<std::int64_t>(distribution(random));
    (i % 3 == 0 ? first : second).record(ns);
    both.record(ns);
  }
  first.merge(LatencyHistogram{});
  first.merge(second);
  CHECK(first.count() == both.count());
  CHECK(first.min() == both.min());
  CHECK(first.max() == both.max());
  CHECK(first.mean() == Approx(both.mean()));
  for (const double p : kPercentiles) CHECK(first.percentile(p) == both.percentile(p));
  first.clear();
  CHECK(first.count() == 0);
  CHECK(first.percentile(99.0) == 0);
}
