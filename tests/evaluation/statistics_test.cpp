// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/statistics.hpp"

#include <cmath>

#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;

TEST_CASE("statistics of a list are those of its definition", "[evaluation][statistics]") {
  const Statistics s = statistics_of({4.0, 1.0, 3.0, 2.0});
  CHECK(s.count == 4);
  CHECK(s.mean == 2.5);
  CHECK(s.median == 2.5);
  CHECK(s.rmse == Approx(std::sqrt(7.5)));
  CHECK(s.deviation == Approx(std::sqrt(1.25)));
  CHECK(s.min == 1.0);
  CHECK(s.max == 4.0);
  CHECK(statistics_of({5.0, -7.0, 1.0}).median == 1.0);
}

TEST_CASE("an empty list has no statistics, not zeros", "[evaluation][statistics]") {
  const Statistics s = statistics_of({});
  CHECK(s.count == 0);
  for (const double value : {s.rmse, s.mean, s.median, s.deviation, s.min, s.max}) CHECK(std::isnan(value));
}

TEST_CASE("chi-square quantiles are those of the printed tables", "[evaluation][statistics]") {
  // NIST/SEMATECH e-Handbook of Statistical Methods, section 1.3.6.7.4.
  CHECK(chi_square_quantile(0.95, 1) == Approx(3.841).margin(5e-4));
  CHECK(chi_square_quantile(0.95, 3) == Approx(7.815).margin(5e-4));
  CHECK(chi_square_quantile(0.025, 6) == Approx(1.237).margin(5e-4));
  CHECK(chi_square_quantile(0.95, 6) == Approx(12.592).margin(5e-4));
  CHECK(chi_square_quantile(0.975, 6) == Approx(14.449).margin(5e-4));
  CHECK(chi_square_quantile(0.05, 100) == Approx(77.929).margin(5e-4));
  CHECK(chi_square_quantile(0.975, 100) == Approx(129.561).margin(5e-4));
  // Two degrees of freedom are an exponential distribution.
  for (const double p : {0.001, 0.1, 0.5, 0.9, 0.999})
    CHECK(chi_square_quantile(p, 2) == Approx(-2.0 * std::log(1.0 - p)).epsilon(1e-9));
}

TEST_CASE("quantiles of many degrees of freedom approach the normal distribution's",
          "[evaluation][statistics]") {
  const double dof = 6.0 * 4541.0;
  // Wilson and Hilferty's cube root, good to 1e-6 here.
  const double cube = 1.0 - 2.0 / (9.0 * dof) + 1.959964 * std::sqrt(2.0 / (9.0 * dof));
  CHECK(chi_square_quantile(0.975, dof) == Approx(dof * cube * cube * cube).epsilon(1e-6));
}

}  // namespace
