// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/kitti/kitti_source.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include "folders.hpp"
#include "support/catch.hpp"
#include "support/new_counter.hpp"

using namespace pago;
using namespace pago::test;
using Catch::Contains;

namespace {

constexpr std::uint32_t kCapacity = 200'000;

/// A sequence of one scan.
struct OneScan {
  explicit OneScan(const KittiScan& scan) { write_scan(root.path() / "velodyne/000000.bin", scan); }
  /// Fills `sweep`, which must succeed.
  void read(Sweep& sweep, const KittiConfig& config = {}) const {
    KittiSource source(root.path(), config);
    REQUIRE(source.fill(sweep));
    CHECK(source.complaint().empty());
  }
  TemporaryPath root{"_kitti"};
};

std::size_t cells_filled(const Sweep& sweep) {
  std::set<std::int32_t> seen;
  for (int ring = 0; ring < kNumRings; ++ring)
    for (int column = 0; column < static_cast<int>(sweep.header.num_columns); ++column) {
      const std::int32_t i = sweep.range_image.at(ring, column);
      if (i == RangeImage::kEmpty) continue;
      REQUIRE((i >= 0 && static_cast<std::uint32_t>(i) < sweep.size));
      REQUIRE(sweep.ring[static_cast<std::size_t>(i)] == ring);
      REQUIRE(sweep.column[static_cast<std::size_t>(i)] == column);
      REQUIRE(seen.insert(i).second);
    }
  return seen.size();
}

}  // namespace

TEST_CASE("a scan in KITTI's order gets its rings from the top and its columns clockwise from the rear",
          "[kitti][source]") {
  const int per_ring = 2160;
  const OneScan folder(round_scan(per_ring));
  Sweep sweep(kCapacity);
  folder.read(sweep);
  REQUIRE(sweep.size == 64 * 2160);
  CHECK(cells_filled(sweep) == sweep.size);
  bool rings_agree = true;
  int farthest = 0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    rings_agree = rings_agree && sweep.ring[i] == 63 - i / per_ring;
    const double turn_rev = std::fmod(1.5 - (i % per_ring + 0.25) / per_ring, 1.0);
    farthest = std::max(farthest, std::abs(sweep.column[i] - static_cast<int>(turn_rev * kKittiColumns)));
  }
  CHECK(rings_agree);
  CHECK(farthest <= 1);
}

TEST_CASE("every point stays in its place, unusable ones without coordinates or cell", "[kitti][source]") {
  KittiScan scan = round_scan(100);
  const float nan = std::numeric_limits<float>::quiet_NaN(),
              infinity = std::numeric_limits<float>::infinity();
  const KittiPoint bad[] = {{nan, 1, 1, 0.5F},
                            {1, infinity, 1, 0.5F},
                            {1, 1, -infinity, 0.5F},
                            {0, 0, 0, 0.5F},
                            {1e30F, 1, 1, 0.5F}};
  for (std::size_t i = 0; i < 5; ++i) scan[700 * i + 50] = bad[i];
  const OneScan folder(scan);
  Sweep sweep(kCapacity);
  KittiConfig config;
  config.vertical_correction_deg = 0.205;
  folder.read(sweep, config);
  REQUIRE(sweep.size == scan.size());
  CHECK(cells_filled(sweep) == scan.size() - 5);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const bool is_bad = i % 700 == 50 && i < 3500;
    REQUIRE(std::isfinite(sweep.x_m[i] + sweep.y_m[i] + sweep.z_m[i]));
    REQUIRE((sweep.x_m[i] == 0.0F && sweep.y_m[i] == 0.0F && sweep.z_m[i] == 0.0F) == is_bad);
    REQUIRE(sweep.ring[i] == 63 - i / 100);
  }
}

TEST_CASE("intensities become bytes whichever scale the file has", "[kitti][source]") {
  KittiScan unit = round_scan(10), bytes = unit;
  const float values[] = {0.0F,         0.25F, 0.99F, 1.0F, -0.5F, std::numeric_limits<float>::quiet_NaN(),
                          0.5F / 255.0F};
  const int expected[] = {0, 64, 252, 255, 0, 0, 1};
  for (std::size_t i = 0; i < 7; ++i) {
    unit[i].intensity = values[i];
    bytes[i].intensity = values[i] * 255.0F;
  }
  Sweep sweep(kCapacity);
  for (const KittiScan& scan : {unit, bytes}) {
    OneScan(scan).read(sweep);
    for (std::size_t i = 0; i < 7; ++i) CHECK(int{sweep.intensity[i]} == expected[i]);
    sweep.reset();
  }
}

TEST_CASE("only uncompensated scans have times, which run clockwise", "[kitti][source]") {
  const TemporaryPath root("_kitti");
  KittiScan scan = round_scan(360);
  scan[0] = point_at(std::numbers::pi / 2, 0.03);  // left: a quarter after the rear seen clockwise
  write_scan(root.path() / "velodyne_points/data/0.bin", scan);
  write_scan(root.path() / "velodyne_points/data/1.bin", scan);
  write_text(root.path() / "velodyne_points/timestamps.txt",
             "2011-09-26 00:00:05.0\n2011-09-26 00:00:05.1\n");
  Sweep sweep(kCapacity);
  {
    KittiSource source(root.path());
    CHECK_FALSE(source.is_compensated());
    REQUIRE(source.fill(sweep));
    CHECK_FALSE(sweep.header.has(kCompensated));
    CHECK(sweep.header.start_ns == kKittiEpochNs + 4'950'000'000);
    CHECK(sweep.header.end_ns == kKittiEpochNs + 5'050'000'000);
    CHECK(std::abs(sweep.time_offset_ns[0] - 25'000'000) < 100);
    for (std::uint32_t i = 1; i < 180; ++i)
      REQUIRE(std::abs(sweep.time_offset_ns[i] - (50.0 - (i + 0.25) / 3.6) * 1e6) < 100.0);
    for (std::uint32_t i = 180; i < 360; ++i)
      REQUIRE(std::abs(sweep.time_offset_ns[i] - (150.0 - (i + 0.25) / 3.6) * 1e6) < 100.0);
  }
  sweep.reset();
  KittiConfig config;
  config.compensated = KittiCompensation::kYes;
  KittiSource source(root.path(), config);
  REQUIRE(source.fill(sweep));
  CHECK(sweep.header.has(kCompensated));
  for (std::uint32_t i = 0; i < sweep.size; ++i) REQUIRE(sweep.time_offset_ns[i] == 0);
}

TEST_CASE("the last scan of a raw recording is partial when it was cut short", "[kitti][source]") {
  const TemporaryPath root("_kitti");
  const auto data = root.path() / "velodyne_points/data";
  write_scan(data / "0.bin", round_scan(360, 0.6));
  write_scan(data / "1.bin", round_scan(360));
  write_scan(data / "2.bin", round_scan(360, 0.6));
  write_text(root.path() / "velodyne_points/timestamps.txt",
             "2011-09-26 00:00:05.0\n2011-09-26 00:00:05.1\n2011-09-26 00:00:05.2\n");
  KittiSource source(root.path());
  Sweep sweep(kCapacity);
  for (int i = 0; i < 3; ++i) {
    sweep.reset();
    REQUIRE(source.fill(sweep));
    CHECK(sweep.header.is_posed() == (i < 2));
    CHECK(sweep.header.rotation_rev == Approx(i < 2 ? 1.0 : 0.6).margin(0.01));
  }
  CHECK(source.scans_with_guessed_rings() == 0);
}

TEST_CASE("the vertical correction turns beams up and nothing else", "[kitti][source]") {
  const KittiScan scan = round_scan(100);
  Sweep sweep(kCapacity);
  KittiConfig config;
  config.vertical_correction_deg = 0.205;
  OneScan(scan).read(sweep, config);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3d before(scan[i].x_m, scan[i].y_m, scan[i].z_m);
    const Eigen::Vector3d after(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    const Eigen::Vector3d axis = before.cross(Eigen::Vector3d::UnitZ()).normalized();
    const Eigen::Vector3d expected = Eigen::AngleAxisd(0.205 * std::numbers::pi / 180.0, axis) * before;
    REQUIRE((after - expected).norm() < 1e-5);
    REQUIRE(after.z() > before.z());
  }
}

TEST_CASE("an overfull ring gives up returns evenly and counts them", "[kitti][source]") {
  const OneScan folder(round_scan(3000));
  KittiSource source(folder.root.path());
  Sweep sweep(kCapacity);
  REQUIRE(source.fill(sweep));
  CHECK(sweep.size == 64 * 3000);
  CHECK(cells_filled(sweep) == 64 * kKittiColumns);
  CHECK(source.returns_without_cell() == 64 * (3000 - kKittiColumns));
}

TEST_CASE("scans that do not go ring by ring are counted", "[kitti][source]") {
  KittiScan scan = round_scan(100);
  std::ranges::reverse(scan);
  const OneScan folder(scan);
  KittiSource source(folder.root.path());
  Sweep sweep(kCapacity);
  REQUIRE(source.fill(sweep));
  CHECK(source.scans_with_guessed_rings() == 1);
}

TEST_CASE("a damaged scan ends the run with file and byte", "[kitti][source]") {
  const TemporaryPath root("_kitti");
  const auto bad = root.path() / "velodyne/000001.bin";
  write_scan(root.path() / "velodyne/000000.bin", round_scan(100));
  write_scan(bad, round_scan(100));
  write_scan(root.path() / "velodyne/000002.bin", round_scan(100));
  Sweep sweep(kCapacity), small(6399);
  const auto complaint = [&](Sweep& second) {
    KittiSource source(root.path());
    sweep.reset();
    REQUIRE(source.fill(sweep));
    second.reset();
    CHECK_FALSE(source.fill(second));
    CHECK_FALSE(source.fill(second));
    CHECK(second.size == 0);
    CHECK(source.progress().done == 1.0);
    CHECK(source.progress().total == 3.0);
    return source.complaint();
  };
  CHECK_THAT(complaint(small), Contains("000001.bin: more points") && Contains("byte 102384"));
  std::filesystem::resize_file(bad, 1605);
  CHECK_THAT(complaint(sweep), Contains(bad.string() + ": ends inside a point") && Contains("byte 1600"));
  std::filesystem::resize_file(bad, 0);
  CHECK_THAT(complaint(sweep), Contains("000001.bin: is empty"));
  std::filesystem::resize_file(bad, (KittiSource::kMaxPoints + 1) * 16);
  CHECK_THAT(complaint(sweep), Contains("000001.bin: more points"));
  std::filesystem::remove(bad);
  std::filesystem::create_directory(bad);
  CHECK_THAT(complaint(sweep), Contains("000001.bin: cannot be read: Is a directory"));
}

TEST_CASE("a file that vanishes after the start is a complaint", "[kitti][source]") {
  const OneScan folder(round_scan(100));
  KittiSource source(folder.root.path());
  std::filesystem::remove(folder.root.path() / "velodyne/000000.bin");
  Sweep sweep(kCapacity);
  CHECK_FALSE(source.fill(sweep));
  CHECK_THAT(source.complaint(), Contains("cannot be opened: No such file"));
}

TEST_CASE("filling allocates nothing", "[kitti][source]") {
  const OneScan folder(round_scan(2100));
  KittiSource source(folder.root.path());
  Sweep sweep(kCapacity);
  const std::uint64_t before = news_so_far();
  const bool filled = source.fill(sweep);
  CHECK(news_so_far() == before);
  CHECK(filled);
  CHECK(source.progress().done == source.progress().total);
  const Sweep planted(1);
  CHECK(news_so_far() > before);
}
