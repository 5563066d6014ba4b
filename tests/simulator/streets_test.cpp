// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/streets.hpp"

#include "drivers/simulator/city.hpp"
#include "support/catch.hpp"

using namespace pago::simulator;
using Eigen::Vector2d;

namespace {

StreetMap cross() {
  std::vector<StreetPoint> all;
  const std::vector<Vector2d> eastward{{-60, 0}, {60, 0}}, northward{{0, -60}, {0, 60}};
  for (const auto& line : {eastward, northward}) {
    const auto street = street_along(line, static_cast<int>(all.empty() ? 0 : 1));
    all.insert(all.end(), street.begin(), street.end());
  }
  return StreetMap(std::move(all));
}

}  // namespace

TEST_CASE("a line becomes points two metres apart that look along it", "[simulator][streets]") {
  const std::vector<Vector2d> bend{{0, 0}, {10, 0}, {10, 10}};
  const auto points = street_along(bend, 7);
  REQUIRE(points.size() == 11);
  CHECK(points[3].at.isApprox(Vector2d(6, 0)));
  CHECK(points[8].at.isApprox(Vector2d(10, 6)));
  CHECK(points[2].along.isApprox(Vector2d(1, 0)));
  CHECK(points[8].along.isApprox(Vector2d(0, 1)));
  CHECK(points[8].from_start_m == 16.0);
  CHECK(points[0].street == 7);
}

TEST_CASE("a place knows its distance from the nearest carriageway's edge", "[simulator][streets]") {
  const StreetMap map = cross();
  const StreetPlace beside = map.nearest({31, 8});
  REQUIRE(beside.point != nullptr);
  CHECK(beside.edge_m == Approx(3.0));
  CHECK(beside.offset_m == Approx(8.0));
  CHECK(map.nearest({31.3, -2}).edge_m == Approx(-3.0));
  CHECK(map.nearest({0, 0}).edge_m == Approx(-5.0));
  CHECK(map.nearest({300, 300}).point == nullptr);
}

TEST_CASE("at a crossing the other street is told apart", "[simulator][streets]") {
  const StreetMap map = cross();
  CHECK(map.nearest_other({8, 1}, 0).edge_m == Approx(3.0));
  CHECK(map.nearest_other({8, 1}, 1).edge_m == Approx(-4.0));
}

TEST_CASE("a city's way keeps to its streets and has no corners", "[simulator][streets]") {
  REQUIRE_THROWS_WITH(make_city(3, 800.0, 100.0), Catch::Contains("simulator.loop_m"));
  const Route city = make_city(3, 800.0);
  REQUIRE(city.way.length_m() >= 800.0);
  const StreetMap map(city.streets);
  double sharpest = 0.0;
  for (double s = 5.0; s < city.way.length_m() - 5.0; s += 1.0) {
    REQUIRE(map.nearest(city.way.at(s)).edge_m < -1.2);
    const Vector2d u = city.way.at(s) - city.way.at(s - 2), v = city.way.at(s + 2) - city.way.at(s);
    sharpest = std::max(sharpest, std::acos(std::min(1.0, u.normalized().dot(v.normalized()))) / 2.0);
  }
  CHECK(sharpest < 1.0 / 7.0);  // per metre
  CHECK(sharpest > 1.0 / 20.0);
}

TEST_CASE("a longer way through the same city begins the same way", "[simulator][streets]") {
  const Route shorter = make_city(5, 300.0), longer = make_city(5, 900.0);
  for (double s = 0.0; s < 300.0; s += 10.0) REQUIRE(shorter.way.at(s).isApprox(longer.way.at(s)));
}
