// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/vehicle.hpp"

#include <cmath>

#include "drivers/simulator/city.hpp"
#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::simulator;
using Eigen::Vector2d;

namespace {

constexpr double kInterval_s = 0.02;

double speed(const std::vector<double>& s, std::size_t i) {
  return (s[i] - s[i - 1]) / kInterval_s;
}

}  // namespace

TEST_CASE("a drive starts at its speed, accelerates and stops where it should", "[simulator][vehicle]") {
  const Way way({{0, 0}, {400, 0}});
  const std::vector<double> stops{150.0};
  const Pace pace{.cruise_m_s = 12.0};
  const auto s = distances_driven(way, stops, pace, kInterval_s, 30.0);
  CHECK(speed(s, 1) < 0.5);
  double fastest = 0.0, hardest = 0.0;
  std::size_t standing = 0;
  for (std::size_t i = 2; i < s.size(); ++i) {
    REQUIRE(s[i] >= s[i - 1]);
    fastest = std::max(fastest, speed(s, i));
    standing += s[i] == s[i - 1] ? 1U : 0U;
    if (speed(s, i) > 1.0 && speed(s, i - 1) > 1.0)
      hardest = std::max(hardest, std::abs(speed(s, i) - speed(s, i - 1)) / kInterval_s);
  }
  CHECK(fastest == Approx(12.0));
  CHECK(hardest < 2.6);
  CHECK(static_cast<double>(standing) * kInterval_s == Approx(pace.stop_s).margin(0.1));

  const auto rolling = distances_driven(way, {}, {.cruise_m_s = 12.0, .start_m_s = 10.0}, kInterval_s, 1.0);
  CHECK(speed(rolling, 1) == Approx(10.0).margin(0.1));
}

TEST_CASE("bends are taken slowly", "[simulator][vehicle]") {
  const Route city = make_city(3, 600.0);
  const Pace pace;
  const auto s = distances_driven(city.way, {}, pace, kInterval_s, 60.0);
  double most = 0.0;
  for (std::size_t i = 50; i + 50 < s.size(); ++i) {
    const Vector2d u = city.way.at(s[i]) - city.way.at(s[i] - 2),
                   v = city.way.at(s[i] + 2) - city.way.at(s[i]);
    const double curvature = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v)) / 2.0;
    most = std::max(most, std::abs(curvature) * speed(s, i) * speed(s, i));
  }
  CHECK(most > 0.7 * pace.lateral_m_s2);
  CHECK(most < 1.5 * pace.lateral_m_s2);
}

TEST_CASE("the vehicle stays on the ground, and heads where it goes", "[simulator][vehicle]") {
  const Route city = make_city(3, 400.0);
  const Ground ground(StreetMap(city.streets), GroundStyle{.speed_bumps = 0.5}, 3);
  const auto s = distances_driven(city.way, city.stops_m, Pace{}, kInterval_s, 30.0);
  const auto poses = drive_over(ground, city.way, s, kInterval_s, 25.0, 3);
  REQUIRE(poses.size() == s.size());
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const Eigen::Vector3d p = poses[i].translation();
    REQUIRE(std::abs(p.z() - ground.road_height_m(ground.spot(p.head<2>()))) < 0.12);
    const RollPitchYaw lean = roll_pitch_yaw(poses[i].linear());
    REQUIRE(std::abs(lean.roll_rad) < 0.1);
    REQUIRE(std::abs(lean.pitch_rad) < 0.2);
    const Eigen::Vector3d step = poses[i].linear().transpose() * (p - poses[i - 1].translation());
    if (step.norm() > 0.05) REQUIRE(std::abs(step.y()) < 0.15 * step.x());
  }
}
