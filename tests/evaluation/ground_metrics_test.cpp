// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_metrics.hpp"

#include <unistd.h>

#include <cmath>
#include <fstream>
#include <set>

#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

namespace {

using namespace pago::evaluation;
using Catch::Matchers::Contains;

constexpr auto kA = GroundProtocol::kPatchwork;
constexpr auto kB = GroundProtocol::kPatchworkPlusPlus;

/// One point per row: what it is, how high, what the method said.
struct Point {
  std::uint32_t label;
  float z_m;
  std::uint8_t mask;
};

GroundCounts count(GroundProtocol protocol, const std::vector<Point>& points) {
  std::vector<std::uint32_t> labels;
  std::vector<float> z_m;
  std::vector<std::uint8_t> mask;
  for (const Point& p : points) {
    labels.push_back(p.label);
    z_m.push_back(p.z_m);
    mask.push_back(p.mask);
  }
  return count_ground(protocol, labels, z_m, mask);
}

const std::vector<Point> kFrame{
    {40, -1.7F, 1}, {44, -1.7F, 1}, {48, -1.6F, 1},  {49, -1.7F, 0},
    {60, -1.7F, 1}, {72, -1.0F, 0},                                  // ground
    {70, -1.5F, 1}, {70, -1.5F, 0}, {70, -1.0F, 1},  {70, 2.0F, 0},  // vegetation: two low, two high
    {70, -1.5F, 1}, {70, -1.4F, 0},                                  // and two low ones more
    {10, -1.7F, 1}, {50, 1.0F, 0},  {252, -1.7F, 1},                 // car, building, moving car
    {0, -1.7F, 1},  {1, -1.7F, 1},  {0, 0.0F, 0},                    // unlabelled, outlier
};

TEST_CASE("a labelled sweep is counted as its spans are", "[evaluation][ground_metrics]") {
  pago::Sweep sweep(static_cast<std::uint32_t>(kFrame.size()));
  for (const Point& p : kFrame) {
    sweep.z_m[sweep.size] = p.z_m;
    sweep.ground[sweep.size] = p.mask;
    sweep.label[sweep.size++] = static_cast<std::uint16_t>(p.label);
  }
  for (const auto protocol : {kA, kB}) {
    const GroundCounts counts = count_ground(protocol, sweep), expected = count(protocol, kFrame);
    CHECK(counts.protocol == expected.protocol);
    CHECK(counts.true_positive == expected.true_positive);
    CHECK(counts.false_positive == expected.false_positive);
    CHECK(counts.false_negative == expected.false_negative);
    CHECK(counts.true_negative == expected.true_negative);
    CHECK(counts.excluded == expected.excluded);
  }
}

TEST_CASE("low vegetation is low as the mount levels it, and whatever height the mount has",
          "[evaluation][ground_metrics]") {
  pago::Sweep sweep(2);
  sweep.size = 2;
  sweep.label[0] = sweep.label[1] = 70;
  sweep.z_m[0] = -1.2F, sweep.z_m[1] = -1.4F;
  for (const double height_m : {0.9, 1.73, 3.0})
    CHECK(count_ground(kA, sweep, {.height_m = height_m}).false_negative == 1);
  sweep.x_m[0] = sweep.x_m[1] = 10.0F;
  CHECK(count_ground(kA, sweep, {.pitch_rad = 0.1}).false_negative == 2);
  CHECK(count_ground(kA, sweep, {.pitch_rad = -0.1}).false_negative == 0);
}

TEST_CASE("protocol A counts low vegetation as ground and the rest of it as not",
          "[evaluation][ground_metrics]") {
  const GroundCounts counts = count(kA, kFrame);
  CHECK(counts.true_positive == 6);
  CHECK(counts.false_negative == 4);
  CHECK(counts.false_positive == 3);
  CHECK(counts.true_negative == 2);
  CHECK(counts.excluded == 3);
  const GroundScore score = ground_score(counts);
  CHECK(score.precision == Approx(6.0 / 9));
  CHECK(score.recall == Approx(6.0 / 10));
  CHECK(score.f1 == Approx(12.0 / 19));
  CHECK(score.accuracy == Approx(8.0 / 15));
  CHECK(score.iou == Approx(6.0 / 13));
}

TEST_CASE("protocol B leaves vegetation out", "[evaluation][ground_metrics]") {
  const GroundCounts counts = count(kB, kFrame);
  CHECK(counts.true_positive == 4);
  CHECK(counts.false_negative == 2);
  CHECK(counts.false_positive == 2);
  CHECK(counts.true_negative == 1);
  CHECK(counts.excluded == 9);
}

TEST_CASE("the instance number in the upper half of a label does not matter",
          "[evaluation][ground_metrics]") {
  const GroundCounts counts = count(kA, {{40U | 7U << 16U, 0.0F, 1}, {10U | 40U << 16U, 0.0F, 1}});
  CHECK(counts.true_positive == 1);
  CHECK(counts.false_positive == 1);
}

TEST_CASE("mask and labels must cover every point", "[evaluation][ground_metrics]") {
  const std::vector<std::uint32_t> labels(3, 40);
  const std::vector<float> z_m(3, 0.0F);
  const std::vector<std::uint8_t> mask(2, 1);
  CHECK_THROWS_WITH(count_ground(kA, labels, z_m, mask), Contains("3 points, 3 labels and a mask of 2"));
  CHECK_THROWS_AS(count_ground(kA, std::span(labels).first(2), z_m, std::vector<std::uint8_t>(3, 1)),
                  pago::Error);
}

TEST_CASE("per-frame means and pooled figures differ as they should", "[evaluation][ground_metrics]") {
  GroundCounts small, large;
  small.true_positive = 1, small.false_positive = 1;
  large.true_positive = 98;
  const GroundSummary summary = summarize_ground(std::vector{small, large});
  CHECK(summary.num_frames == 2);
  CHECK(summary.mean.precision == Approx(0.75));
  CHECK(summary.deviation.precision == Approx(0.25));
  CHECK(summary.pooled.precision == Approx(0.99));
  CHECK(summary.mean.recall == Approx(1.0));
}

TEST_CASE("frames of the two protocols are never mixed", "[evaluation][ground_metrics]") {
  GroundCounts a, b;
  a.protocol = kA, b.protocol = kB;
  CHECK_THROWS_WITH(summarize_ground(std::vector{a, b}), Contains("protocol A and by protocol B"));
  CHECK_THROWS_AS(summarize_ground({}), pago::Error);
  CHECK(summarize_ground(std::vector{b}).protocol == kB);
  CHECK(to_string(kA) != to_string(kB));
}

TEST_CASE("a ratio of nothing to nothing is not defined, and in no mean", "[evaluation][ground_metrics]") {
  CHECK(std::isnan(ground_score({}).f1));
  const GroundCounts missed = count(kA, {{40, -1.7F, 0}, {40, -1.7F, 0}});
  const GroundScore score = ground_score(missed);
  CHECK(std::isnan(score.precision));
  CHECK(score.recall == 0.0);
  CHECK(score.f1 == 0.0);

  const GroundCounts found = count(kA, {{40, -1.7F, 1}, {10, -1.7F, 1}});
  const GroundSummary both = summarize_ground(std::vector{missed, found});
  CHECK(both.num_frames == 2);
  CHECK(both.mean.precision == Approx(0.5));  // of the second alone
  CHECK(both.deviation.precision == Approx(0.0));
  CHECK(both.mean.recall == Approx(0.5));
  CHECK(std::isnan(summarize_ground(std::vector{missed}).mean.precision));
}

TEST_CASE("frames without ground count in no mean", "[evaluation][ground_metrics]") {
  const GroundCounts found = count(kA, {{40, -1.7F, 1}, {40, -1.7F, 0}});
  const GroundCounts unlabelled = count(kA, {{0, -1.7F, 1}, {1, -1.7F, 0}});
  const GroundCounts wall = count(kA, {{50, 0.0F, 1}});
  const GroundSummary summary = summarize_ground(std::vector{unlabelled, found, wall});
  CHECK(summary.num_frames == 1);
  CHECK(summary.mean.recall == Approx(0.5));
  CHECK(summary.mean.precision == Approx(1.0));
  CHECK(summary.pooled.precision == Approx(0.5));
  CHECK(std::isnan(summarize_ground(std::vector{unlabelled}).mean.f1));
}

TEST_CASE("label files are refused by name when they do not fit the scan", "[evaluation][ground_metrics]") {
  const auto path = std::filesystem::temp_directory_path() / ("pago_label_" + std::to_string(::getpid()));
  std::ofstream(path, std::ios::binary) << std::string("\x28\x00\x01\x00\x46\x00\x00\x00", 8);
  CHECK(read_semantic_labels(path, 2) == std::vector<std::uint32_t>{0x10028, 0x46});
  CHECK_THROWS_WITH(read_semantic_labels(path, 3), Contains("has 8 bytes, 3 points need 12"));
  std::filesystem::remove(path);
  CHECK_THROWS_WITH(read_semantic_labels(path, 2), Contains("cannot be opened"));
}

TEST_CASE("on the labelled scan the true mask scores 1 and a full mask the share of ground",
          "[evaluation][ground_metrics]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  std::ifstream stream(folder / "velodyne/000000.bin", std::ios::binary);
  std::vector<float> z_m;
  for (float xyzi[4]; stream.read(reinterpret_cast<char*>(xyzi), sizeof xyzi);) z_m.push_back(xyzi[2]);
  const auto labels = read_semantic_labels(folder / "labels/000000.label", z_m.size());
  const std::set<std::uint32_t> ground{40, 44, 48, 49, 60, 72};

  std::vector<std::uint8_t> truth(z_m.size());
  std::size_t num_ground = 0, num_known = 0;
  for (std::size_t i = 0; i < z_m.size(); ++i) {
    const std::uint32_t label = labels[i] & 0xFFFF;
    truth[i] = ground.contains(label) ? 1 : 0;
    num_ground += truth[i];
    num_known += label > 1 && label != 70 ? 1 : 0;
  }
  REQUIRE(num_ground > 10'000);
  CHECK(ground_score(count_ground(kB, labels, z_m, truth)).f1 == 1.0);
  const GroundScore full =
      ground_score(count_ground(kB, labels, z_m, std::vector<std::uint8_t>(z_m.size(), 1)));
  CHECK(full.recall == 1.0);
  CHECK(full.precision == Approx(static_cast<double>(num_ground) / static_cast<double>(num_known)));
  // By A the same mask misses the low vegetation.
  CHECK(ground_score(count_ground(kA, labels, z_m, truth)).recall < 1.0);
}

}  // namespace
