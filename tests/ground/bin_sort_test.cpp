// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/bin_sort.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include "support/catch.hpp"

using namespace pago::ground;

namespace {

constexpr int kBins = 50;

/// Returns that can be told apart, each with its bin; kBins = none.
struct BinnedCloud {
  explicit BinnedCloud(std::uint32_t size) : x(size), y(size), z(size), bin(size) {
    std::mt19937 random(5);
    for (std::uint32_t i = 0; i < size; ++i) {
      x[i] = static_cast<float>(i);
      y[i] = -x[i];
      z[i] = 0.5F * x[i];
      bin[i] = static_cast<std::uint16_t>(random() % (kBins + 1));
    }
  }
  std::uint32_t size() const { return static_cast<std::uint32_t>(x.size()); }
  Coordinates view() const { return {x.data(), y.data(), z.data()}; }
  std::vector<float> expected(int b) const {
    std::vector<float> result;
    for (std::uint32_t i = 0; i < size(); ++i)
      if (bin[i] == b) result.push_back(x[i]);
    return result;
  }
  std::vector<float> x, y, z;
  std::vector<std::uint16_t> bin;
};

void note(BinSort& sort, const BinnedCloud& cloud, std::uint32_t until) {
  std::copy(cloud.bin.begin() + sort.noted(), cloud.bin.begin() + until, sort.bin_of() + sort.noted());
  sort.note(until);
}

std::vector<float> found(const Points& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    REQUIRE(points.y_m[k] == -points.x_m[k]);
    REQUIRE(points.z_m[k] == 0.5F * points.x_m[k]);
  }
  return {points.x_m.begin(), points.x_m.end()};
}

void check_all(const BinSort& sort, const BinnedCloud& cloud) {
  for (int bin = 0; bin < kBins; ++bin) REQUIRE(found(sort.points(bin)) == cloud.expected(bin));
}

}  // namespace

TEST_CASE("bins hold their returns in the sweep's order, noted at once or bit by bit", "[ground][bin_sort]") {
  for (const std::uint32_t size : {0U, 1U, 3U, 4U, 5U, 1000U, 4999U}) {
    const BinnedCloud cloud(size);
    BinSort sort(kBins, 5000);
    sort.begin();
    note(sort, cloud, size);
    sort.sort_rest(cloud.view());
    check_all(sort, cloud);

    sort.begin();
    for (std::uint32_t until = 0; until < size; until += 37) note(sort, cloud, until);
    note(sort, cloud, size);
    sort.sort_rest(cloud.view());
    check_all(sort, cloud);
  }
}

TEST_CASE("bins that are sorted early hold the same, and each is fresh once", "[ground][bin_sort]") {
  BinnedCloud cloud(4000);
  std::ranges::sort(cloud.bin);  // bin after bin, so that bins can close
  BinSort sort(kBins, 4000);
  sort.begin();
  std::vector<int> times_fresh(kBins, 0);
  const auto count_fresh = [&] {
    for (int bin = 0; bin < kBins; ++bin) times_fresh[static_cast<std::size_t>(bin)] += sort.is_fresh(bin);
  };
  std::uint16_t next = 0;
  for (std::uint32_t until = 500; until < cloud.size(); until += 500) {
    note(sort, cloud, until);
    std::vector<std::uint16_t> closed;
    for (; next < cloud.bin[until - 1]; ++next) closed.push_back(next);
    sort.sort(cloud.view(), closed);
    for (const int bin : closed) REQUIRE(found(sort.points(bin)) == cloud.expected(bin));
    count_fresh();
  }
  note(sort, cloud, cloud.size());
  CHECK(sort.is_sorted(0));
  CHECK_FALSE(sort.is_sorted(kBins - 1));
  sort.sort_rest(cloud.view());
  count_fresh();
  check_all(sort, cloud);
  CHECK(times_fresh == std::vector<int>(kBins, 1));
}

TEST_CASE("a return that comes too late has all bins sorted anew", "[ground][bin_sort]") {
  const BinnedCloud cloud(2000);  // in any order, so nearly every bin gets one too late
  BinSort sort(kBins, 2000);
  sort.begin();
  note(sort, cloud, 1000);
  std::vector<std::uint16_t> some{3, 4, 5, 30};
  sort.sort(cloud.view(), some);
  CHECK(found(sort.points(30)) != cloud.expected(30));
  note(sort, cloud, 2000);
  sort.sort_rest(cloud.view());
  check_all(sort, cloud);
  for (int bin = 0; bin < kBins; ++bin) REQUIRE(sort.is_fresh(bin));
}

TEST_CASE("neighbouring bins that were sorted at once can be read as one", "[ground][bin_sort]") {
  const BinnedCloud cloud(1000);
  BinSort sort(kBins, 1000);
  sort.begin();
  note(sort, cloud, 1000);
  sort.sort_rest(cloud.view());
  std::vector<float> both = cloud.expected(7);
  const auto second = cloud.expected(8);
  both.insert(both.end(), second.begin(), second.end());
  CHECK(found(sort.points(7, 9)) == both);
}
