// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/ground/column_test.hpp"

#include <limits>
#include <vector>

#include "support/catch.hpp"

using namespace pago::ground;

namespace {

/// One column of returns, bottom first, as (x, z); x NaN = an empty cell.
struct Column {
  std::vector<float> x, z;
  bool missing_undoes = false;

  std::vector<int> ground() const {
    const std::vector<float> y(x.size(), 0.0F);
    std::vector<std::int32_t> cells(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) cells[i] = x[i] == x[i] ? static_cast<std::int32_t>(i) : -1;
    const ColumnTest test{.pairs = static_cast<int>(x.size()) - 1,
                          .max_slope_sq = 0.031091F,
                          .min_range_sq_m2 = 1.0F,
                          .missing_undoes = missing_undoes};
    std::vector<int> result(x.size(), -1);
    test_columns(test, {x.data(), y.data(), z.data()}, IndexImage{cells.data(), 1}, 0, 1,
                 [&](int row, int, const StripVerdict& verdict, int) {
                   result[static_cast<std::size_t>(row)] = verdict[0];
                 });
    return result;
  }
};

constexpr float kEmpty = std::numeric_limits<float>::quiet_NaN();

}  // namespace

TEST_CASE("a level pair is ground, a steep one is not", "[ground][column_test]") {
  CHECK(Column{{4, 5, 6}, {-1.7F, -1.7F, -1.7F}}.ground() == std::vector{1, 1, 1});
  CHECK(Column{{4, 5, 5}, {-1.7F, -1.7F, -1.2F}}.ground() == std::vector{1, 1, 0});
  CHECK(Column{{4, 4, 4}, {-1.7F, -1.2F, -0.7F}}.ground() == std::vector{0, 0, 0});
}

TEST_CASE("ten degrees is the limit, up and down", "[ground][column_test]") {
  CHECK(Column{{4, 5}, {0, 0.1762F}}.ground() == std::vector{1, 1});
  CHECK(Column{{4, 5}, {0, 0.1764F}}.ground() == std::vector{0, 0});
  CHECK(Column{{4, 5}, {0, -0.1762F}}.ground() == std::vector{1, 1});
  CHECK(Column{{4, 5}, {0, -0.1764F}}.ground() == std::vector{0, 0});
}

TEST_CASE("a missing neighbour undoes the verdict from below only where LeGO-LOAM's code is reproduced",
          "[ground][column_test]") {
  const std::vector<float> x{4, 5, kEmpty, 7}, z{0, 0, 0, 0};
  CHECK(Column{x, z, false}.ground() == std::vector{1, 1, 0, 0});
  CHECK(Column{x, z, true}.ground() == std::vector{1, 0, 0, 0});
}

TEST_CASE("returns nearer than the minimum range, or infinite, count as missing", "[ground][column_test]") {
  CHECK(Column{{0.5F, 0.6F, 5, 6}, {0, 0, 0, 0}}.ground() == std::vector{0, 0, 1, 1});
  const float far = std::numeric_limits<float>::infinity();
  CHECK(Column{{5, far, far, 6}, {0, 0, 0, 0}}.ground() == std::vector{0, 0, 0, 0});
}

TEST_CASE("columns do not see each other across strips", "[ground][column_test]") {
  constexpr int kColumns = 3 * kStripColumns + 5;
  // Two rows; every third column is steep.
  std::vector<float> x(2 * kColumns), y(2 * kColumns, 0.0F), z(2 * kColumns);
  std::vector<std::int32_t> cells(2 * kColumns);
  for (std::size_t c = 0; c < kColumns; ++c) {
    x[c] = 5.0F;
    x[kColumns + c] = 6.0F;
    z[kColumns + c] = c % 3 == 0 ? 1.0F : 0.0F;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = static_cast<std::int32_t>(i);
  std::vector<int> ground(2 * kColumns, -1);
  test_columns({.pairs = 1, .max_slope_sq = 0.03F, .min_range_sq_m2 = 0.0F, .missing_undoes = false},
               {x.data(), y.data(), z.data()}, {cells.data(), kColumns}, 0, kColumns,
               [&](int row, int column, const StripVerdict& verdict, int width) {
                 for (int k = 0; k < width; ++k)
                   ground[static_cast<std::size_t>(row * kColumns + column + k)] =
                       verdict[static_cast<std::size_t>(k)];
               });
  for (std::size_t i = 0; i < ground.size(); ++i) REQUIRE(ground[i] == (i % kColumns % 3 == 0 ? 0 : 1));
}
