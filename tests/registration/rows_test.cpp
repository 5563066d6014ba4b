// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/rows.hpp"

#include <random>

#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::registration;

namespace {

struct Draws {
  Eigen::Vector3d vector(double size) {
    return size * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  }
  std::mt19937 random{11};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
};

/// Rows of unit variance of points on planes with the given normals.
FixedVector<Row> rows_of(const std::vector<Eigen::Vector3f>& normals, int per_normal) {
  Draws draws;
  FixedVector<Row> rows(normals.size() * static_cast<std::size_t>(per_normal));
  for (const Eigen::Vector3f& normal : normals)
    for (int i = 0; i < per_normal; ++i)
      rows.push_back(plane_row(draws.vector(20.0).cast<float>(), normal, 0.0F, 1.0F));
  return rows;
}

WeakDirections weak_of(const FixedVector<Row>& rows) {
  NormalEquations sum;
  sum.add(rows.view());
  return find_weak_directions(sum.H, rows.view(), 10.0);
}

}  // namespace

TEST_CASE("the derivative of a point's distance to a plane is the numeric one", "[registration][rows]") {
  Draws draws;
  for (int draw = 0; draw < 50; ++draw) {
    Vector6d xi;
    xi << draws.vector(5.0), draws.vector(1.0);
    const Eigen::Isometry3d T = exp_se3(xi);
    const Eigen::Vector3d p = draws.vector(40.0), normal = draws.vector(1.0).normalized();
    const auto residual = [&](const Vector6d& d) { return normal.dot(perturb(T, d) * p); };
    const Row row = plane_row(p.cast<float>(), (T.linear().transpose() * normal).cast<float>(), 0.0F, 1.0F);
    for (int k = 0; k < 6; ++k) {
      constexpr double kStep = 1e-6;
      const double numeric =
          (residual(kStep * Vector6d::Unit(k)) - residual(-kStep * Vector6d::Unit(k))) / (2 * kStep);
      REQUIRE(static_cast<double>(row.J[k]) == Approx(numeric).margin(1e-4));
    }
  }
}

TEST_CASE("sums of rows are weighted by kernel and variance", "[registration][rows]") {
  FixedVector<Row> rows(2);
  rows.push_back(plane_row({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 2.0F, 4.0F));
  rows.push_back(plane_row({0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, 1.0F, 1.0F));
  rows[1].kernel_weight = 0.5F;
  NormalEquations sum;
  sum.add(rows.view());
  REQUIRE(sum.H(0, 0) == Approx(0.25 + 0.5));
  REQUIRE(sum.b[0] == Approx(0.25 * 2.0 + 0.5 * 1.0));
  REQUIRE(sum.rms_m() == Approx(std::sqrt((0.25 * 4.0 + 0.5 * 1.0) / 0.75)));
  REQUIRE(NormalEquations{}.rms_m() == 0.0);
}

TEST_CASE("three families of planes leave no direction open", "[registration][weak]") {
  const WeakDirections weak = weak_of(rows_of({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 100));
  REQUIRE(weak.count == 0);
  REQUIRE(weak.axes == 0);
  REQUIRE(weak.penalty.isZero());
}

TEST_CASE("floor and side walls leave the way ahead open, floor alone x, y and yaw", "[registration][weak]") {
  const WeakDirections tunnel = weak_of(rows_of({{0, 1, 0}, {0, 0, 1}}, 100));
  CHECK(tunnel.count == 1);
  CHECK(tunnel.axes == 0b000001);
  const WeakDirections field = weak_of(rows_of({{0, 0, 1}}, 100));
  CHECK(field.count == 3);
  CHECK(field.axes == 0b100011);
}

TEST_CASE("a lone car ahead does not make the way ahead observable, four walls across it do",
          "[registration][weak]") {
  Draws draws;
  const auto tunnel_with = [&](int walls) {
    FixedVector<Row> rows(1000);
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3f normal = i % 2 == 0 ? Eigen::Vector3f::UnitY() : Eigen::Vector3f::UnitZ();
      rows.push_back(plane_row(draws.vector(20.0).cast<float>(), normal, 0.0F, 1.0F));
    }
    for (int i = 0; i < 40; ++i) {
      const Eigen::Vector3f at(30.0F - 8.0F * static_cast<float>(i % walls), 0.01F * static_cast<float>(i),
                               0.0F);
      rows.push_back(plane_row(at, Eigen::Vector3f::UnitX(), 0.0F, 1.0F));
    }
    NormalEquations sum;
    sum.add(rows.view());
    return find_weak_directions(sum.H, rows.view(), 3.5);
  };
  CHECK(tunnel_with(1).axes == 0b000001);
  CHECK(tunnel_with(4).count == 0);
}

TEST_CASE("noise in the normals does not count as evidence, and is taken out", "[registration][weak]") {
  Draws draws;
  FixedVector<Row> rows(3000);
  for (int i = 0; i < 3000; ++i) {
    const Eigen::Vector3d normal =
        (i % 2 == 0 ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ()) + draws.vector(0.06);
    rows.push_back(
        plane_row(draws.vector(20.0).cast<float>(), normal.normalized().cast<float>(), 0.0F, 1.0F));
  }
  const WeakDirections weak = weak_of(rows);
  REQUIRE(weak.count == 1);
  NormalEquations sum;
  sum.add(rows.view());
  REQUIRE(sum.H(0, 0) > 1.0);
  REQUIRE(weak.without(sum.H)(0, 0) < 1e-2 * sum.H(0, 0));
  REQUIRE(weak.without(sum.H)(1, 1) == Approx(sum.H(1, 1)).epsilon(0.01));
}
