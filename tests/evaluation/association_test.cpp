// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/association.hpp"

#include "evaluation/paths.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using namespace pago::test;
using Catch::Matchers::Contains;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart_ns = 1'317'378'034'500'000'000;

Trajectory stamped(int steps, std::int64_t start_ns, std::int64_t interval_ns, const std::string& name) {
  Trajectory trajectory = chain(planar(1, 0, 0), steps, name);
  stamp(trajectory, start_ns, interval_ns);
  return trajectory;
}

TEST_CASE("rows are matched by number", "[evaluation][association]") {
  const Trajectory truth = chain(planar(1, 0, 0), 9, "truth"),
                   estimate = chain(planar(2, 0, 0), 9, "estimate");
  const MatchedTrajectories matched = match(truth, estimate, {});
  CHECK(matched.how == "by row");
  REQUIRE(matched.poses.size() == 10);
  CHECK(matched.poses[4].row == 4);
  CHECK(matched.poses[4].T_world_sensor_truth.translation().x() == 4.0);
  CHECK(matched.poses[4].T_world_sensor_estimate->translation().x() == 8.0);
}

TEST_CASE("files of different length are not matched by row unless rows are chosen",
          "[evaluation][association]") {
  const Trajectory truth = chain(planar(1, 0, 0), 9, "truth.txt"),
                   estimate = chain(planar(1, 0, 0), 7, "estimate.txt");
  CHECK_THROWS_WITH(match(truth, estimate, {}),
                    Contains("estimate.txt: has 8 poses, truth.txt has 10 poses"));
  MatchOptions options;
  options.rows = RowRange{2, 7};
  const MatchedTrajectories matched = match(truth, estimate, options);
  REQUIRE(matched.poses.size() == 6);
  CHECK(matched.poses.front().row == 2);
  options.rows = RowRange{0, 8};
  CHECK_THROWS_WITH(match(truth, estimate, options), Contains("estimate.txt: has no row 8"));
}

TEST_CASE("a row range is two numbers in order", "[evaluation][association]") {
  CHECK(parse_row_range("0-152").first == 0);
  CHECK(parse_row_range("0-152").last == 152);
  CHECK(parse_row_range("7-7").last == 7);
  for (const char* text :
       {"", "5", "5-", "-5", "9-5", "1-2-3", "a-b", "1 - 2", "1-2x", "99999999999999999999-1"})
    CHECK_THROWS_AS(parse_row_range(text), pago::Error);
}

TEST_CASE("stamps find each other within the maximum difference", "[evaluation][association]") {
  const Trajectory truth = stamped(9, kStart_ns, 100 * kMs, "truth");
  Trajectory estimate = stamped(9, kStart_ns + 15 * kMs, 100 * kMs, "estimate");
  estimate.poses.erase(estimate.poses.begin() + 4);
  const MatchedTrajectories matched = match(truth, estimate, {});
  REQUIRE(matched.poses.size() == 10);
  CHECK(matched.num_matched() == 9);
  for (const MatchedPose& pose : matched.poses) {
    CHECK(pose.T_world_sensor_estimate.has_value() == (pose.row != 4));
    if (pose.T_world_sensor_estimate)
      CHECK(pose.T_world_sensor_estimate->translation().x() == static_cast<double>(pose.row));
  }
  CHECK_THROWS_WITH(match(truth, estimate, {.matching = Matching::kStamp, .max_difference_s = 0.01}),
                    Contains("estimate: no stamp within 0.010 s"));
}

TEST_CASE("one pose of the estimate never serves two rows of the truth", "[evaluation][association]") {
  const Trajectory truth = stamped(9, kStart_ns, 100 * kMs, "truth");
  Trajectory estimate = stamped(0, kStart_ns + 340 * kMs, 100 * kMs, "estimate");
  const MatchedTrajectories matched =
      match(truth, estimate, {.matching = Matching::kAuto, .max_difference_s = 1.0});
  CHECK(matched.num_matched() == 1);
  CHECK(matched.poses[3].T_world_sensor_estimate.has_value());
}

TEST_CASE("a dense truth is read at the estimate's stamps", "[evaluation][association]") {
  const Trajectory truth = stamped(200, kStart_ns, 5 * kMs, "truth");  // 1 m per 5 ms
  const Trajectory estimate = stamped(9, kStart_ns + 2 * kMs, 100 * kMs, "estimate");
  const MatchedTrajectories matched = match(truth, estimate, {});
  REQUIRE(matched.poses.size() == 10);
  CHECK(matched.num_matched() == 10);
  CHECK(matched.poses[3].row == 3);
  CHECK(matched.poses[3].T_world_sensor_truth.translation().x() == Approx(60.4));
  CHECK(matched.how == "by stamp within 0.020 s, truth interpolated");
  CHECK(matched.notes.empty());
}

TEST_CASE("what an estimate lacks is told where its rows are the base", "[evaluation][association]") {
  const Trajectory truth = stamped(200, kStart_ns, 5 * kMs, "truth");
  Trajectory estimate = stamped(12, kStart_ns, 100 * kMs, "estimate");  // the last two after the truth's end
  estimate.poses.erase(estimate.poses.begin() + 4, estimate.poses.begin() + 6);
  const MatchedTrajectories matched = match(truth, estimate, {});
  CHECK(matched.poses.size() == 9);
  REQUIRE(matched.notes.size() == 2);
  CHECK_THAT(matched.notes[0], Contains("2 of 11 poses have no truth near them"));
  CHECK_THAT(matched.notes[1], Contains("lacks about 2 poses, for at most 0.30 s"));
}

TEST_CASE("stamps half-way between two of the other file find one of them", "[evaluation][association]") {
  const Trajectory truth = stamped(9, kStart_ns, 100 * kMs, "truth");
  for (const std::int64_t offset_ns : {-50 * kMs, 50 * kMs}) {
    const auto matched = match(truth, stamped(9, kStart_ns + offset_ns, 100 * kMs, "estimate"),
                               {.matching = Matching::kAuto, .max_difference_s = 0.06});
    CHECK(matched.num_matched() >= 9);
    for (std::size_t i = 1; i < matched.poses.size(); ++i)
      if (matched.poses[i].T_world_sensor_estimate && matched.poses[i - 1].T_world_sensor_estimate)
        CHECK(matched.poses[i].estimate_row == matched.poses[i - 1].estimate_row + 1);
  }
}

TEST_CASE("truth is interpolated only between its own stamps", "[evaluation][association]") {
  const Trajectory truth = stamped(10, kStart_ns, 100 * kMs, "truth");
  MatchOptions options;
  options.interpolates_truth = true;
  options.max_difference_s = 0.06;
  const MatchedTrajectories matched =
      match(truth, stamped(12, kStart_ns - 50 * kMs, 100 * kMs, "estimate"), options);
  REQUIRE(matched.poses.size() == 10);
  CHECK(matched.poses.front().row == 1);
  CHECK(matched.poses.front().T_world_sensor_truth.translation().x() == Approx(0.5));
  CHECK(matched.poses.back().row == 10);
}

TEST_CASE("clocks that have nothing in common are named", "[evaluation][association]") {
  const Trajectory truth = stamped(9, kStart_ns, 100 * kMs, "truth"),
                   estimate = stamped(9, 0, 100 * kMs, "estimate");
  CHECK_THROWS_WITH(match(truth, estimate, {}), Contains("1317378034.500 to 1317378035.400 s"));
}

TEST_CASE("matching by stamp needs stamps", "[evaluation][association]") {
  const Trajectory plain = chain(planar(1, 0, 0), 9, "plain.txt");
  CHECK_THROWS_WITH(match(plain, stamped(9, 0, kMs, "b"), {.matching = Matching::kStamp}),
                    Contains("plain.txt: has no stamps"));
  CHECK(match(plain, stamped(9, 0, kMs, "b"), {}).how == "by row");
}

TEST_CASE("truth of another instant is carried on to the estimate's", "[evaluation][association]") {
  // 1 m per row at a turn rate, seen at the sweeps' middles and at their ends.
  const Eigen::Isometry3d half = planar(0.5, 0.02, 0.05);
  const Trajectory fine = chain(half, 20, "fine");
  Trajectory mid{.name = "mid", .poses = {}}, end{.name = "end", .poses = {}};
  for (std::size_t i = 0; i < 10; ++i) {
    mid.poses.push_back({std::nullopt, fine.poses[2 * i].T_world_sensor, i});
    end.poses.push_back({std::nullopt, fine.poses[2 * i + 1].T_world_sensor, i});
  }
  MatchOptions options;
  options.instant_shift_rows = 0.5;
  const MatchedTrajectories matched = match(mid, end, options);
  CHECK(matched.how == "by row, truth carried on by +0.5 rows");
  REQUIRE(matched.poses.size() == 9);  // the last end is beyond the last middle
  for (const MatchedPose& pose : matched.poses)
    CHECK((pose.T_world_sensor_truth.matrix() - pose.T_world_sensor_estimate->matrix()).norm() < 1e-12);
  options.instant_shift_rows = -0.5;
  CHECK(match(end, mid, options).poses.front().row == 1);
  options.instant_shift_rows = 1.5;
  CHECK_THROWS_AS(match(end, mid, options), pago::Error);
}

TEST_CASE("a time offset brings two clocks together, and the refusal names it", "[evaluation][association]") {
  const Trajectory truth = stamped(9, kStart_ns, 100 * kMs, "truth"),
                   estimate = stamped(9, 5'000 * kMs, 100 * kMs, "estimate");
  CHECK_THROWS_WITH(match(truth, estimate, {}), Contains("a time offset of 1317378029.500 s"));
  MatchOptions options;
  options.time_offset_s = 1317378029.5;
  const MatchedTrajectories matched = match(truth, estimate, options);
  CHECK(matched.num_matched() == 10);
  CHECK(matched.poses[3].stamp_ns == truth.poses[3].stamp_ns);
  CHECK(matched.poses[3].estimate_row == 3);
  CHECK_THAT(matched.how, Contains("offset +1317378029.500 s"));
  options.instant_shift_rows = 0.5;
  CHECK_THROWS_WITH(match(truth, estimate, options), Contains("by stamp give a time offset"));
}

}  // namespace
