// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/deskew.hpp"

#include "support/catch.hpp"

using namespace pago;

TEST_CASE("points are moved as the exact motion moves them", "[core][deskew]") {
  MotionInSweep motion;
  motion.twist << 12.0, 0.5, -0.3, 0.2, -0.5, 1.2;
  motion.acceleration << 3.0, -1.0, 4.0, 1.0, 5.0, -2.0;
  const Deskew to_reference(motion);
  const Eigen::Vector3d p(18.0, -25.0, 1.0);
  for (const double before_s : {-0.05, -0.02, 0.0, 0.03, 0.05}) {
    const Eigen::Vector3d exact = motion.pose_at(-before_s) * p;
    const Eigen::Vector3f moved = to_reference(p.cast<float>(), static_cast<float>(before_s));
    INFO(before_s << " s: " << (moved.cast<double>() - exact).transpose());
    CHECK((moved.cast<double>() - exact).norm() < 2e-4);
  }
}

TEST_CASE("a motion without acceleration is one at constant velocity", "[core][deskew]") {
  Vector6d twist;
  twist << 10.0, 0.0, 0.1, 0.01, -0.02, 0.3;
  const Eigen::Vector3f p(5.0F, 30.0F, -1.5F);
  CHECK(Deskew(twist)(p, 0.04F) == Deskew(MotionInSweep{twist})(p, 0.04F));
  CHECK(MotionInSweep{twist}.pose_at(0.1).isApprox(exp_se3(0.1 * twist)));
  CHECK(MotionInSweep{twist}.twist_at(1.0) == twist);
}
