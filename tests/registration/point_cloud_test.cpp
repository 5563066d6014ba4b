// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/point_cloud.hpp"

#include <random>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::registration;

TEST_CASE("de-skewing agrees with the exact exponential at motorway speed and in sharp turns",
          "[registration][deskew]") {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> coordinate(-80.0F, 80.0F), before(0.0F, 0.1F);
  PointCloud raw(2000), moved(2000);
  for (int i = 0; i < 2000; ++i) {
    raw.add({coordinate(random), coordinate(random), 0.05F * coordinate(random)}, before(random), 3);
  }
  Vector6d twist;
  twist << 30.0, 0.5, 0.2, 0.05, -0.08, 1.0;  // 30 m/s, 57 degrees per second
  deskew(raw, twist, moved);

  REQUIRE(moved.size == raw.size);
  for (std::size_t i = 0; i < raw.size; ++i) {
    const Eigen::Vector3d exact =
        exp_se3(-static_cast<double>(raw.before_s[i]) * twist) * raw.point(i).cast<double>();
    REQUIRE((moved.point(i).cast<double>() - exact).norm() < 1e-3);
    REQUIRE(moved.tag[i] == 3);
  }
}

TEST_CASE("without motion de-skewing changes nothing", "[registration][deskew]") {
  PointCloud raw(1), moved(1);
  raw.add({1.0F, -2.0F, 3.0F}, 0.07F, 5);
  deskew(raw, Vector6d::Zero(), moved);
  REQUIRE(moved.point(0) == raw.point(0));
}

TEST_CASE("a full cloud refuses a point and keeps the others", "[registration][deskew]") {
  PointCloud cloud(1);
  REQUIRE(cloud.add({1.0F, 2.0F, 3.0F}, 0.0F, 0));
  REQUIRE_FALSE(cloud.add({4.0F, 5.0F, 6.0F}, 0.0F, 0));
  REQUIRE(cloud.size == 1);
  REQUIRE(cloud.point(0) == Eigen::Vector3f(1.0F, 2.0F, 3.0F));
}
