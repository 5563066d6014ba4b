// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "folders.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/kitti_scan.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr std::uint32_t kSweepCapacity = 200'000;

double elevation_rad(const Sweep& sweep, std::size_t i) {
  const double x = static_cast<double>(sweep.x_m[i]), y = static_cast<double>(sweep.y_m[i]);
  return std::atan2(static_cast<double>(sweep.z_m[i]), std::hypot(x, y));
}

/// Where the return's azimuth lies among the columns.
double true_column(const Sweep& sweep, std::size_t i) {
  const double azimuth_rad = std::atan2(static_cast<double>(sweep.y_m[i]), static_cast<double>(sweep.x_m[i]));
  return (0.5 - azimuth_rad / (2.0 * std::numbers::pi)) * kKittiColumns;
}

void check_rings_rise(const Sweep& sweep) {
  std::array<double, kNumRings> sum{};
  std::array<int, kNumRings> count{};
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    sum[sweep.ring[i]] += elevation_rad(sweep, i);
    ++count[sweep.ring[i]];
  }
  for (std::size_t ring = 0; ring < kNumRings; ++ring) {
    REQUIRE(count[ring] > 500);
    if (ring > 0) CHECK(sum[ring] / count[ring] > sum[ring - 1] / count[ring - 1]);
  }
}

/// One cell per return, in the order of azimuth, near its azimuth.
void check_range_image(const Sweep& sweep) {
  std::vector<double> distances;
  int out_of_order = 0;
  for (int ring = 0; ring < kNumRings; ++ring) {
    double last = -1.0;
    for (int column = 0; column < kKittiColumns; ++column) {
      const std::int32_t cell = sweep.range_image.at(ring, column);
      if (cell == RangeImage::kEmpty) continue;
      const auto i = static_cast<std::size_t>(cell);
      REQUIRE(sweep.ring[i] == ring);
      REQUIRE(sweep.column[i] == column);
      const double position = true_column(sweep, i);
      out_of_order += position < last - 1e-3 ? 1 : 0;
      last = position;
      distances.push_back(std::abs(column + 0.5 - position));
    }
  }
  CHECK(distances.size() == sweep.size);
  CHECK(out_of_order == 0);
  std::ranges::sort(distances);
  CHECK(distances[distances.size() / 2] < 0.4);
  CHECK(distances[distances.size() * 99 / 100] < 7.0);
  CHECK(distances.back() < 16.0);
}

}  // namespace

TEST_CASE("KITTI's scans become ring-exact sweeps with a cell for every return", "[kitti][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/odometry_00_000000-000015");
  KittiSource source(folder);
  CHECK(source.is_compensated());
  CHECK(source.has_stamps());
  const auto files = kitti_scans(folder / "velodyne");
  const std::vector<double> stamps_s = [&] {
    std::ifstream in(folder / "times.txt");
    return std::vector<double>(std::istream_iterator<double>(in), {});
  }();
  Sweep sweep(kSweepCapacity), plain(kSweepCapacity);
  std::size_t scans = 0;
  for (; source.fill(sweep); ++scans, sweep.reset()) {
    INFO("scan " << scans);
    load_kitti_points(files.at(scans), plain);
    REQUIRE(sweep.size == plain.size);
    CHECK(std::equal(sweep.x_m.begin(), sweep.x_m.begin() + sweep.size, plain.x_m.begin()));
    CHECK(std::equal(sweep.z_m.begin(), sweep.z_m.begin() + sweep.size, plain.z_m.begin()));
    CHECK(std::equal(sweep.intensity.begin(), sweep.intensity.begin() + sweep.size, plain.intensity.begin()));
    check_rings_rise(sweep);
    check_range_image(sweep);
    CHECK(sweep.header.sequence == scans);
    CHECK(sweep.header.has(kCompensated));
    CHECK(sweep.header.is_posed());
    const double mid_s =
        static_cast<double>(sweep.header.start_ns + sweep.header.end_ns - 2 * kKittiEpochNs) / 2e9;
    CHECK(mid_s == Approx(stamps_s.at(scans)).margin(1e-6));
    CHECK(static_cast<double>(sweep.header.end_ns - sweep.header.start_ns) == Approx(0.1036e9).epsilon(0.01));
  }
  CHECK(scans == 16);
  CHECK(source.complaint().empty());
  CHECK(source.scans_with_guessed_rings() == 0);
  CHECK(source.returns_without_cell() == 0);
}

TEST_CASE("the labelled scan keeps a return per label", "[kitti][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  KittiSource source(folder);
  CHECK_FALSE(source.has_stamps());
  Sweep sweep(kSweepCapacity);
  REQUIRE(source.fill(sweep));
  CHECK(sweep.size == std::filesystem::file_size(folder / "labels/000000.label") / 4);
  CHECK(source.scans_with_guessed_rings() == 0);
  check_rings_rise(sweep);
  check_range_image(sweep);
  CHECK_FALSE(source.fill(sweep));
}
