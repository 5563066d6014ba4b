// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/timed_equations.hpp"

#include <Eigen/Cholesky>
#include <random>
#include <utility>
#include <vector>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::registration;

namespace {

std::vector<std::pair<Row, float>> random_rows(int count, float within_s) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  std::vector<std::pair<Row, float>> rows;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3f p = 20.0F * Eigen::Vector3f(unit(random), unit(random), unit(random));
    Row row = plane_row(p, Eigen::Vector3f(unit(random), unit(random), unit(random)).normalized(),
                        0.1F * unit(random), 1e-3F + 1e-3F * std::abs(unit(random)));
    row.kernel_weight = std::abs(unit(random));
    rows.emplace_back(row, within_s * unit(random));
  }
  return rows;
}

}  // namespace

TEST_CASE("a motion and how it bends are what the equations by time say", "[registration][timed]") {
  Vector6d motion;
  Vector12d bend;
  motion << 0.02, -0.01, 0.03, 0.001, 0.002, -0.001;
  bend << 0.3, 0.1, -0.2, 0.02, -0.03, 0.05, 2.0, -1.0, 3.0, 0.5, 1.5, -0.4;
  TimedEquations timed;
  timed.clear();
  NormalEquations together;
  for (auto [row, before_s] : random_rows(3000, 0.05F)) {
    const double s = -static_cast<double>(before_s);
    const Vector6d at_its_time = motion + s * bend.head<6>() + 0.5 * s * s * bend.tail<6>();
    row.residual_m = -static_cast<float>(row.J.cast<double>().dot(at_its_time));
    timed.add(row, before_s);
    together.add({&row, 1});
  }
  const NormalEquations sum = timed.sum();
  CHECK(sum.H.isApprox(together.H, 1e-9));
  CHECK(sum.b.isApprox(together.b, 1e-9));
  CHECK(sum.rms_m() == Approx(together.rms_m()));

  const BendEquations bends = timed.bends();
  Eigen::Matrix<double, 18, 18> H;
  H << sum.H, bends.motion_bend, bends.motion_bend.transpose(), bends.bend_bend;
  Eigen::Matrix<double, 18, 1> b;
  b << sum.b, bends.b;
  const Eigen::Matrix<double, 18, 1> found = H.ldlt().solve(-b);
  INFO(found.transpose());
  CHECK((found.head<6>() - motion).norm() < 0.01 * motion.norm());
  CHECK((found.segment<6>(6) - bend.head<6>()).norm() < 0.02 * bend.head<6>().norm());
  // Within a bin all rows count as seen at the same time.
  CHECK((found.tail<6>() - bend.tail<6>()).norm() < 0.1 * bend.tail<6>().norm());
}

TEST_CASE("slow rotations and empty sweeps have equations, too", "[registration][timed]") {
  TimedEquations timed;
  timed.clear();
  CHECK(timed.sum().H.isZero());
  CHECK(timed.bends().bend_bend.isZero());
  double weight = 0.0;
  for (const auto& [row, before_s] : random_rows(100, 1.0F)) {
    timed.add(row, before_s);
    weight += static_cast<double>(row.kernel_weight / row.variance_m2);
  }
  CHECK(timed.sum().weight == Approx(weight));
  timed.clear();
  CHECK(timed.sum().weight == 0.0);
}
