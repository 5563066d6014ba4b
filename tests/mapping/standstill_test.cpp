// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/standstill.hpp"

#include <random>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::mapping;

namespace {

constexpr double kNoise_m = 0.003;

/// A sensor whose measured poses are off by a few millimetres.
struct Sensor {
  Eigen::Isometry3d measure(double forward_m) {
    Vector6d xi = Vector6d::Zero();
    xi[0] = forward_m + noise(random), xi[1] = noise(random);
    const Eigen::Isometry3d T_measured = exp_se3(xi);
    const Eigen::Isometry3d T_believed = standstill.update(T_measured, T_last.inverse() * T_measured,
                                                           Matrix6d::Identity() / (kNoise_m * kNoise_m));
    T_last = T_believed;
    return T_believed;
  }
  std::mt19937 random{1};
  std::normal_distribution<double> noise{0.0, kNoise_m};
  Standstill standstill;
  Eigen::Isometry3d T_last = Eigen::Isometry3d::Identity();
};

}  // namespace

TEST_CASE("standing, the noise of poses is averaged away", "[mapping][standstill]") {
  Sensor sensor;
  Eigen::Isometry3d T;
  for (int i = 0; i < 40; ++i) T = sensor.measure(0.0);
  REQUIRE(sensor.standstill.is_standing());
  REQUIRE(T.translation().norm() < 0.5 * kNoise_m);
}

TEST_CASE("a walking pace is motion at once", "[mapping][standstill]") {
  Sensor sensor;
  for (int i = 0; i < 20; ++i) sensor.measure(0.0);
  for (int i = 1; i <= 10; ++i) {
    const double at_m = 0.1 * i;
    REQUIRE(sensor.measure(at_m).translation().x() == Approx(at_m).margin(4.0 * kNoise_m));
    REQUIRE_FALSE(sensor.standstill.is_standing());
  }
}

TEST_CASE("a creep of 2 cm/s is followed", "[mapping][standstill]") {
  Sensor sensor;
  for (int i = 0; i < 20; ++i) sensor.measure(0.0);
  for (int i = 1; i <= 200; ++i) sensor.measure(0.002 * i);
  REQUIRE(sensor.T_last.translation().x() == Approx(0.4).margin(0.05));
}
