// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/roof.hpp"

#include <cmath>
#include <numbers>

#include "support/catch.hpp"

using namespace pago::simulator;

namespace {

/// A beam so far to the left of ahead, and so far up.
bool is_hidden(double azimuth_deg, double elevation_deg) {
  constexpr double kRadPerDeg = std::numbers::pi / 180.0;
  const double a = azimuth_deg * kRadPerDeg, e = elevation_deg * kRadPerDeg;
  return meets_roof({std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)});
}

}  // namespace

TEST_CASE("the roof hides the lowest beams ahead and behind, as on KITTI's car", "[simulator][roof]") {
  CHECK(is_hidden(0.0, -24.3));
  CHECK(is_hidden(20.0, -24.3));
  CHECK_FALSE(is_hidden(30.0, -24.3));
  CHECK_FALSE(is_hidden(90.0, -24.3));
  CHECK(is_hidden(140.0, -24.3));
  CHECK_FALSE(is_hidden(0.0, -20.8));
  CHECK(is_hidden(180.0, -18.8));
  CHECK_FALSE(is_hidden(180.0, -17.8));
  CHECK_FALSE(is_hidden(180.0, 2.0));
}

TEST_CASE("it hides a third of the lowest ring", "[simulator][roof]") {
  int hidden = 0;
  for (int azimuth_deg = 0; azimuth_deg < 360; ++azimuth_deg) hidden += is_hidden(azimuth_deg, -24.3) ? 1 : 0;
  CHECK(hidden > 110);
  CHECK(hidden < 145);
}
