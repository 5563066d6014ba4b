// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/course.hpp"

#include <cmath>

#include "evaluation/paths.hpp"
#include "pago/evaluation/statistics.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;

TEST_CASE("the error along the way is the absolute error of the same alignment", "[evaluation][course]") {
  const Trajectory truth = winding(1, 300, "truth");
  const auto matched = by_row(truth, drifting(truth, 2));
  for (std::size_t i = 0; i < static_cast<std::size_t>(Alignment::kCount); ++i) {
    const auto alignment = static_cast<Alignment>(i);
    std::vector<double> errors;
    for (const CoursePoint& point : course_of(matched, alignment)) errors.push_back(point.error_m);
    const AbsoluteErrors absolute = absolute_errors(matched, alignment);
    CHECK(statistics_of(errors).rmse == Approx(absolute.rmse_m));
    CHECK(statistics_of(errors).max == Approx(absolute.max_m));
  }
}

TEST_CASE("drift starts at zero and grows by what each motion adds", "[evaluation][course]") {
  const Trajectory truth = moved(planar(5, 6, 1), chain(planar(1, 0, 0), 100, "truth"));
  Eigen::Isometry3d step = planar(1, 0, 0);
  step.rotate(Eigen::AngleAxisd(1e-4, Eigen::Vector3d::UnitY()));
  const auto course = course_of(by_row(truth, chain(step, 100, "nose down")), Alignment::kSe3);
  REQUIRE(course.size() == 101);
  CHECK(course.front().drift_m.norm() < 1e-12);
  CHECK(course.back().distance_m == Approx(100));
  // Pitch down by 1e-4 rad per metre: sum of i * 1e-4 for i = 0 ... 99.
  CHECK(course.back().drift_rpy_rad.y() == Approx(0.01));
  CHECK(course.back().drift_m.z() == Approx(-1e-4 * 99 * 100 / 2).epsilon(1e-3));
  CHECK(std::abs(course.back().drift_rpy_rad.x()) < 1e-12);
}

TEST_CASE("rows without an estimate leave a hole in the course, not in the distance",
          "[evaluation][course]") {
  const Trajectory truth = chain(planar(1, 0, 0), 10, "truth");
  MatchedTrajectories matched = by_row(truth, truth);
  matched.poses[4].T_world_sensor_estimate.reset();
  const auto course = course_of(matched, Alignment::kNone);
  REQUIRE(course.size() == 10);
  CHECK(course[4].row == 5);
  CHECK(course[4].distance_m == Approx(5));
}

}  // namespace
