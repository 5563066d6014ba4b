// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/relative_error.hpp"

#include <algorithm>
#include <complex>

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "pago/core/units.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;

TEST_CASE("a scale error of one percent is one percent per nominal length", "[evaluation][relative_error]") {
  const Trajectory truth = chain(planar(0.75, 0, 0), 1300, "truth");
  const Trajectory estimate = chain(planar(0.75 * 1.01, 0, 0), 1300, "estimate");
  const RelativeErrors errors = relative_errors(by_row(truth, estimate));
  REQUIRE(errors.by_length.size() == 8);
  // E = inv(estimate) * truth: from an end that lies too far ahead, the true one is behind.
  for (const SegmentError& segment : errors.segments) CHECK(segment.translation_per_axis.x() < -0.01);
  for (const DriftRates& rates : errors.by_length) {
    // The devkit ends a segment at the first pose beyond the length: 100 m is 134 steps of 0.75 m = 100.5 m.
    const double true_length_m = 0.75 * (std::floor(rates.length_m / 0.75) + 1.0);
    CHECK(rates.t_rel_percent == Approx(true_length_m / rates.length_m).epsilon(1e-9));
    CHECK(rates.axis_percent.x() == Approx(rates.t_rel_percent));
    CHECK(rates.axis_percent.tail<2>().norm() < 1e-9);
    CHECK(rates.r_rel_deg_per_100m == Approx(0.0).margin(1e-9));
  }
}

TEST_CASE("a yaw drift of 0.01 degrees per metre is one degree per hundred metres",
          "[evaluation][relative_error]") {
  const double turn_rad = 0.01 * kDegree;
  const Trajectory truth = chain(planar(1.0, 0, 0), 400, "truth");
  const Trajectory estimate = chain(planar(1.0, 0, turn_rad), 400, "estimate");
  const RelativeErrors errors =
      relative_errors(by_row(truth, estimate), {.lengths_m = {99.5, 199.5}, .step_rows = 10});
  REQUIRE(errors.by_length.size() == 2);
  for (const DriftRates& rates : errors.by_length) {
    const double steps = rates.length_m + 0.5;
    CHECK(rates.r_rel_deg_per_100m == Approx(1.0 * steps / rates.length_m).epsilon(1e-9));
    CHECK(rates.axis_deg_per_100m.z() == Approx(rates.r_rel_deg_per_100m));
    CHECK(rates.axis_deg_per_100m.head<2>().norm() < 1e-9);
    // Steps of one metre, each turned against the last: a geometric series in the complex plane.
    const std::complex<double> one{1.0, 0.0};
    const std::complex<double> end =
        (one - std::polar(1.0, steps * turn_rad)) / (one - std::polar(1.0, turn_rad));
    CHECK(rates.t_rel_percent == Approx(100.0 * std::abs(end - steps) / rates.length_m).epsilon(1e-9));
  }
}

TEST_CASE("each axis of rotation drift is told apart", "[evaluation][relative_error]") {
  const Trajectory truth = chain(planar(1.0, 0, 0), 200, "truth");
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Isometry3d step = planar(1.0, 0, 0);
    step.rotate(Eigen::AngleAxisd(0.001 * kDegree, Eigen::Vector3d::Unit(axis)));
    const auto rates =
        relative_errors(by_row(truth, chain(step, 200, "estimate")), {.lengths_m = {100}, .step_rows = 10})
            .overall;
    for (int other = 0; other < 3; ++other)
      CHECK(rates.axis_deg_per_100m[other] == Approx(other == axis ? 0.101 : 0.0).margin(1e-9));
  }
}

TEST_CASE("a rigid offset is no relative error", "[evaluation][relative_error]") {
  std::mt19937 random(4);
  const Trajectory truth = winding(1, 500, "truth");
  const auto rates = relative_errors(by_row(truth, moved(random_motion(random, 50, 2), truth)),
                                     {.lengths_m = {50, 100}, .step_rows = 10})
                         .overall;
  CHECK(rates.num_segments > 50);
  CHECK(rates.t_rel_percent < 1e-10);
  CHECK(rates.r_rel_deg_per_100m < 1e-10);
}

TEST_CASE("relative errors do not change when both worlds are moved", "[evaluation][relative_error]") {
  const Trajectory truth = winding(1, 500, "truth");
  const Trajectory estimate = drifting(truth, 2);
  const SegmentOptions options{.lengths_m = {50, 100}, .step_rows = 10};
  const DriftRates before = relative_errors(by_row(truth, estimate), options).overall;
  std::mt19937 random(3);
  for (int i = 0; i < 10; ++i) {
    const auto T = random_motion(random, 100, 2), T_other = random_motion(random, 100, 2);
    const DriftRates after =
        relative_errors(by_row(moved(T, truth), moved(T_other, estimate)), options).overall;
    CHECK(after.t_rel_percent == Approx(before.t_rel_percent).epsilon(1e-9));
    CHECK(after.r_rel_deg_per_100m == Approx(before.r_rel_deg_per_100m).epsilon(1e-9));
    CHECK((after.axis_percent - before.axis_percent).norm() < 1e-9);
  }
}

TEST_CASE("a missing estimate removes its segments and leaves the others as they were",
          "[evaluation][relative_error]") {
  const Trajectory truth = winding(1, 500, "truth");
  MatchedTrajectories matched = by_row(truth, drifting(truth, 2));
  const SegmentOptions options{.lengths_m = {50, 100}, .step_rows = 10};
  const RelativeErrors full = relative_errors(matched, options);
  for (const std::size_t row : {0U, 20U, 21U, 22U, 23U, 260U})
    matched.poses[row].T_world_sensor_estimate.reset();
  const RelativeErrors holed = relative_errors(matched, options);
  CHECK(holed.num_skipped >= 3);
  REQUIRE(holed.segments.size() + holed.num_skipped == full.segments.size());
  auto next = full.segments.begin();
  for (const SegmentError& segment : holed.segments) {
    next = std::find_if(next, full.segments.end(), [&](const SegmentError& s) {
      return s.first == segment.first && s.length_m == segment.length_m;
    });
    REQUIRE(next != full.segments.end());
    CHECK(next->last == segment.last);
    CHECK(next->translation == segment.translation);
  }
}

TEST_CASE("the overall error is the mean over segments, not over lengths", "[evaluation][relative_error]") {
  const Trajectory truth = winding(1, 220, "truth");
  const RelativeErrors errors =
      relative_errors(by_row(truth, drifting(truth, 2)), {.lengths_m = {20, 200}, .step_rows = 1});
  REQUIRE(errors.by_length.size() == 2);
  const DriftRates &few = errors.by_length[1], &many = errors.by_length[0];
  REQUIRE(many.num_segments > 3 * few.num_segments);
  const double n = static_cast<double>(few.num_segments), m = static_cast<double>(many.num_segments);
  CHECK(errors.overall.t_rel_percent == Approx((n * few.t_rel_percent + m * many.t_rel_percent) / (n + m)));
}

TEST_CASE("a path shorter than every length has no relative error, not zero",
          "[evaluation][relative_error]") {
  const Trajectory truth = chain(planar(1, 0, 0), 70, "truth");
  const RelativeErrors errors = relative_errors(by_row(truth, truth));
  CHECK(errors.segments.empty());
  CHECK(errors.by_length.empty());
  CHECK(std::isnan(errors.overall.t_rel_percent));
  CHECK(relative_errors(by_row(truth, truth), {.lengths_m = {20, 40, 60}, .step_rows = 10}).segments.size() ==
        5 + 3 + 1);
}

TEST_CASE("lengths and steps that make no sense are refused", "[evaluation][relative_error]") {
  const Trajectory truth = chain(planar(1, 0, 0), 70, "truth");
  const auto score = [&](const SegmentOptions& options) {
    return relative_errors(by_row(truth, truth), options);
  };
  CHECK_THROWS_AS(score({.lengths_m = {}, .step_rows = 10}), pago::Error);
  CHECK_THROWS_AS(score({.lengths_m = {100, 0}, .step_rows = 10}), pago::Error);
  CHECK_THROWS_AS(score({.lengths_m = {-1}, .step_rows = 10}), pago::Error);
  CHECK_THROWS_AS(score({.lengths_m = {std::nan("")}, .step_rows = 10}), pago::Error);
  CHECK_THROWS_AS(score({.lengths_m = {100}, .step_rows = 0}), pago::Error);
}

TEST_CASE("segments are sorted by their speed, each into two neighbours", "[evaluation][relative_error]") {
  // 200 m at 5 m/s, then 200 m at 12.4 m/s, at ten rows per second; 1 % too long in the slow half alone.
  std::vector<Eigen::Isometry3d> truth{Eigen::Isometry3d::Identity()}, estimate = truth;
  for (int i = 0; i < 561; ++i) {
    const double step_m = i < 400 ? 0.5 : 1.24;
    truth.push_back(truth.back() * planar(step_m, 0, 0));
    estimate.push_back(estimate.back() * planar(i < 400 ? 1.01 * step_m : step_m, 0, 0));
  }
  Trajectory a = trajectory_of(truth, "truth"), b = trajectory_of(estimate, "estimate");
  const SegmentOptions options{.lengths_m = {20}, .step_rows = 10};
  const auto by_speed = relative_errors(by_row(a, b), options).by_speed;
  const auto at = [&](double speed) {
    return std::find_if(by_speed.begin(), by_speed.end(),
                        [&](const DriftRates& rates) { return rates.speed_m_per_s == speed; });
  };
  REQUIRE(at(4) != by_speed.end());
  REQUIRE(at(6) != by_speed.end());
  CHECK(at(2) == by_speed.end());
  // 41 steps are the first beyond 20 m; those that end in the fast half err less.
  CHECK(at(4)->t_rel_percent == Approx(1.025).epsilon(0.01));
  CHECK(at(6)->num_segments >= at(4)->num_segments);
  CHECK(at(12)->t_rel_percent < 0.1);
  CHECK(at(18) == by_speed.end());

  // Twice as fast by the stamps.
  stamp(a, 0, 50'000'000);
  stamp(b, 0, 50'000'000);
  const auto faster = relative_errors(match(a, b, {}), options).by_speed;
  CHECK(faster.back().speed_m_per_s == Approx(26.0).margin(2));
  CHECK_THROWS_AS(relative_errors(by_row(a, b), {.lengths_m = {20}, .step_rows = 10, .row_interval_s = 0.0}),
                  pago::Error);
}

}  // namespace
