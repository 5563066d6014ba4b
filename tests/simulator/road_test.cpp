// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/road.hpp"

#include <cmath>

#include "drivers/simulator/city.hpp"
#include "drivers/simulator/presets.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::simulator;
using Eigen::Vector2d;

namespace {

double sharpest(const Way& way) {
  double most = 0.0;
  for (double s = 5.0; s < way.length_m() - 5.0; s += 1.0) {
    const Vector2d u = way.at(s) - way.at(s - 2.0), v = way.at(s + 2.0) - way.at(s);
    most = std::max(most, std::abs(std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v))) / 2.0);
  }
  return most;
}

}  // namespace

TEST_CASE("a loop comes back to where it began, on the same street", "[simulator][road]") {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Route road = make_road(RoadShape{}, seed, 2500.0, 1000.0);
    CHECK(road.way.length_m() > 2500.0);
    CHECK(road.streets.size() == Approx(500.0).margin(60.0));  // closing it takes some of its length
    double nearest_m = 1e9;
    for (double s = 900.0; s < 1150.0; s += 0.5)
      nearest_m = std::min(nearest_m, (road.way.at(s) - road.way.at(20.0)).norm());
    CHECK(nearest_m < 0.5);
    CHECK(sharpest(road.way) < 0.12);
  }
  const Route city = make_city(5, 1500.0, 900.0);
  double nearest_m = 1e9;
  for (double s = 700.0; s < 1100.0; s += 0.5)
    nearest_m = std::min(nearest_m, (city.way.at(s) - city.way.at(30.0)).norm());
  CHECK(nearest_m < 0.5);
}

TEST_CASE("a road in the country has sharp bends, a highway none", "[simulator][road]") {
  CHECK(sharpest(make_road(preset_of(SimulatedWorld::kRural).road, 1, 3000.0, 0.0).way) > 0.02);
  CHECK(sharpest(make_road(preset_of(SimulatedWorld::kHighway).road, 1, 3000.0, 0.0).way) < 0.004);
}

TEST_CASE("the vehicle keeps to its own carriageway", "[simulator][road]") {
  const RoadShape shape = preset_of(SimulatedWorld::kHighway).road;
  const Route road = make_road(shape, 3, 1000.0, 0.0);
  const StreetMap streets(road.streets);
  for (double s = 10.0; s < 900.0; s += 10.0) {
    const StreetPlace place = streets.nearest(road.way.at(s));
    REQUIRE(place.point != nullptr);
    REQUIRE(place.point->street == 0);
    REQUIRE(place.offset_m == Approx(-shape.lane_m).margin(0.05));
  }
}

TEST_CASE("a loop that would cross itself is refused", "[simulator][road]") {
  REQUIRE_THROWS_WITH(make_road(RoadShape{}, 1, 500.0, 100.0), Catch::Contains("simulator.loop_m"));
}
