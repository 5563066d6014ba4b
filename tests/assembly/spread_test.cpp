// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/assembly/spread.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "support/catch.hpp"

using namespace pago;

namespace {

double cost(float position, int cell) {
  const double d = cell + 0.5 - static_cast<double>(position);
  return d * d;
}

/// The least sum of squared distances of any strictly rising cells, by trying all: best[c] after i positions
/// is the least cost with the i-th in a cell below c.
double least_cost(const std::vector<float>& positions, int num_cells) {
  const auto n = static_cast<std::size_t>(num_cells);
  std::vector<double> best(n + 1, 0.0);
  for (const float position : positions) {
    std::vector<double> next(n + 1, std::numeric_limits<double>::infinity());
    for (std::size_t c = 0; c < n; ++c)
      next[c + 1] = std::min(next[c], best[c] + cost(position, static_cast<int>(c)));
    best = next;
  }
  return best[n];
}

}  // namespace

TEST_CASE("positions get cells of their own, in order, at the least possible distance",
          "[assembly][spread]") {
  std::mt19937 random(4);
  Spreader spreader(64);
  for (int round = 0; round < 2000; ++round) {
    const int num_cells = 1 + static_cast<int>(random() % 64);
    std::vector<float> positions(random() % static_cast<unsigned>(num_cells + 1));
    // From evenly spaced to all in one spot.
    std::uniform_real_distribution<float> place(
        0.0F, static_cast<float>(num_cells) / static_cast<float>(1 + round % 7));
    for (float& p : positions) p = place(random);
    std::ranges::sort(positions);

    const auto cells = spreader.spread(positions, num_cells);
    REQUIRE(cells.size() == positions.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      REQUIRE((cells[i] >= 0 && cells[i] < num_cells));
      if (i > 0) REQUIRE(cells[i] > cells[i - 1]);
      sum += cost(positions[i], cells[i]);
    }
    REQUIRE(sum == Approx(least_cost(positions, num_cells)).margin(1e-3));
  }
}

TEST_CASE("positions that do not compete keep their cells", "[assembly][spread]") {
  Spreader spreader(4);
  const std::vector<float> positions{0.1F, 3.9F, 4.0F, 9.99F};
  const auto cells = spreader.spread(positions, 10);
  CHECK(std::vector<int>(cells.begin(), cells.end()) == std::vector<int>{0, 3, 4, 9});
}
