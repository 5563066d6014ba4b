// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/returns.hpp"

#include <cmath>

#include "support/catch.hpp"

using namespace pago::simulator;

namespace {

constexpr Surface kWall{Material::kPlaster, 128, Label::kBuilding},
    kRoad{Material::kAsphalt, 128, Label::kRoad};
constexpr ReturnModel kExact{.range_noise_m = 0.0};

/// Part of 4,000 beams that come back.
double share_detected(const simulator::Echo& echo, const ReturnModel& model) {
  int detected = 0;
  for (int i = 0; i < 4000; ++i) {
    Random random(1, i);
    detected += returns_of(model, {echo, {}}, 1, {}, random)[0].is_there ? 1 : 0;
  }
  return detected / 4000.0;
}

Returns two(const simulator::Echo& a, const simulator::Echo& b) {
  Random random(7);
  return returns_of(kExact, {a, b}, 2, {}, random);
}

}  // namespace

TEST_CASE("what is near and bright comes back, what is far, dark and grazing does not",
          "[simulator][returns]") {
  CHECK(share_detected({10.0, 1.0, kWall, 1.0}, kExact) > 0.99);
  CHECK(share_detected({100.0, 1.0, kWall, 1.0}, kExact) > 0.9);
  const auto road = [](double range) { return simulator::Echo{range, 1.9 / range, kRoad, 1.0}; };
  CHECK(share_detected(road(10.0), kExact) > 0.99);
  CHECK(share_detected(road(50.0), kExact) == Approx(0.5).margin(0.1));
  CHECK(share_detected(road(110.0), kExact) < 0.1);
}

TEST_CASE("a wet road loses half of its returns at 11 m and nearly all from 25 m on, a wall none",
          "[simulator][returns]") {
  const ReturnModel wet{.range_noise_m = 0.0, .wetness = 1.0};
  const auto road = [](double range_m) { return simulator::Echo{range_m, 1.9 / range_m, kRoad, 1.0}; };
  CHECK(share_detected(road(11.0), kExact) > 0.97);
  CHECK(share_detected(road(5.0), wet) > 0.85);
  CHECK(share_detected(road(11.0), wet) == Approx(0.5).margin(0.1));
  CHECK(share_detected(road(25.0), wet) < 0.05);
  CHECK(share_detected({16.0, 1.0, kWall, 1.0}, wet) > 0.99);
}

TEST_CASE("a laser's own losses come on top", "[simulator][returns]") {
  int detected = 0;
  for (int i = 0; i < 4000; ++i) {
    Random random(1, i);
    detected +=
        returns_of(kExact, {simulator::Echo{5.0, 1.0, kWall, 1.0}, {}}, 1, {1.0, 0.08}, random)[0].is_there
            ? 1
            : 0;
  }
  CHECK(detected / 4000.0 == Approx(0.92).margin(0.02));
}

TEST_CASE("intensities are levelled up to 25 m, and fade out beyond", "[simulator][returns]") {
  const auto intensity = [](double range_m, double cos_incidence, const Surface& surface) {
    double sum = 0.0;
    for (int i = 0; i < 500; ++i) {
      Random random(9, i);
      sum += returns_of(kExact, {simulator::Echo{range_m, cos_incidence, surface, 1.0}, {}}, 1, {}, random)[0]
                 .intensity;
    }
    return sum / 500.0;
  };
  for (const double range_m : {5.0, 10.0, 20.0})
    CHECK(intensity(range_m, 1.9 / range_m, kRoad) == Approx(66.0).margin(6.0));
  CHECK(intensity(10.0, 0.9, kWall) == Approx(105.0).margin(8.0));
  CHECK(intensity(50.0, 0.9, kWall) < 35.0);
}

TEST_CASE("echoes closer than a pulse merge to one between them", "[simulator][returns]") {
  const Returns merged = two({10.0, 1.0, kWall, 0.6}, {10.5, 1.0, kRoad, 0.4});
  REQUIRE(merged[0].is_there);
  CHECK(merged[0].range_m > 10.0);
  CHECK(merged[0].range_m < 10.5);
  CHECK(merged[0].label == Label::kBuilding);
  CHECK_FALSE(merged[1].is_there);
}

TEST_CASE("echoes farther apart are two, the strongest first", "[simulator][returns]") {
  const Returns both = two({10.0, 1.0, kRoad, 0.3}, {14.0, 1.0, kWall, 0.7});
  CHECK(both[0].range_m == Approx(14.0));
  CHECK(both[0].label == Label::kBuilding);
  CHECK(both[1].range_m == Approx(10.0));
}

TEST_CASE("rain comes back from near by, dark, as an outlier", "[simulator][returns]") {
  const ReturnModel rain{.outliers = 0.1};
  int drops = 0;
  for (int i = 0; i < 4000; ++i) {
    Random random(3, i);
    const Return r = returns_of(rain, {simulator::Echo{30.0, 1.0, kWall, 1.0}, {}}, 1, {}, random)[0];
    if (r.label != Label::kOutlier) continue;
    ++drops;
    REQUIRE(r.range_m < 16.0);
    REQUIRE(r.intensity < 30.0);
  }
  CHECK(drops / 4000.0 == Approx(0.1).margin(0.02));
}

TEST_CASE("grass stops beams early", "[simulator][returns]") {
  double sum = 0.0;
  for (int i = 0; i < 2000; ++i) {
    Random random(5, i);
    const Return r =
        returns_of(kExact, {simulator::Echo{10.0, 0.2, {Material::kGrass, 128, Label::kTerrain}, 1.0}, {}}, 1,
                   {}, random)[0];
    REQUIRE(r.range_m <= 10.0);
    REQUIRE(r.range_m >= 9.5);
    sum += 10.0 - r.range_m;
  }
  CHECK(sum / 2000 == Approx(0.004 / 0.2).epsilon(0.15));
}

TEST_CASE("nothing in the beam, nothing returned", "[simulator][returns]") {
  Random random(1);
  const Returns none = returns_of(kExact, {}, 0, {}, random);
  CHECK_FALSE(none[0].is_there);
  CHECK_FALSE(none[1].is_there);
}
