// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/odometry.hpp"

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "pago/assembly/scan_organizer.hpp"
#include "pago/core/error.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "support/alloc_guard.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/kitti_scan.hpp"
#include "support/street.hpp"
#include "support/temporary_path.hpp"

using namespace pago;

namespace {

constexpr std::int64_t kPeriod_ns = 100'000'000;

/// A scan that owns its arrays.
struct OwnedScan {
  std::vector<Eigen::Vector3f> points_m;
  std::vector<float> times_s;
  std::vector<std::uint8_t> rings;
  std::int64_t stamp_ns = 0, duration_ns = kPeriod_ns;

  Scan view() const { return {points_m, times_s, rings, stamp_ns, duration_ns}; }
};

/// The i-th rotation of a drive along the street, distorted by the motion; times of points whole float32.
OwnedScan street_scan(int i, const Vector6d& twist) {
  static const test::Street street;
  Sweep sweep(test::kStreetReturns);
  const Eigen::Isometry3d T_world_start = test::street_start() * exp_se3(twist * (0.1 * i));
  street.scan(T_world_start, twist, i * kPeriod_ns, 0.01, sweep);
  OwnedScan scan;
  scan.stamp_ns = sweep.header.start_ns;
  for (std::uint32_t k = 0; k < sweep.size; ++k) {
    scan.points_m.emplace_back(sweep.x_m[k], sweep.y_m[k], sweep.z_m[k]);
    scan.times_s.push_back(static_cast<float>(sweep.time_offset_ns[k]) * 1e-9F);
    scan.rings.push_back(sweep.ring[k]);
  }
  return scan;
}

Vector6d drive_twist() {
  Vector6d twist = Vector6d::Zero();
  twist[0] = 8.0, twist[5] = 0.1;
  return twist;
}

std::vector<OwnedScan> street_drive(int num_scans) {
  std::vector<OwnedScan> scans;
  for (int i = 0; i < num_scans; ++i) scans.push_back(street_scan(i, drive_twist()));
  return scans;
}

/// Scans as a driver would hand them to the pipeline.
class MemoryScans final : public SweepSource {
 public:
  explicit MemoryScans(const std::vector<OwnedScan>& scans) : scans_(scans) {}

  bool fill(Sweep& sweep) noexcept override {
    if (next_ == scans_.size()) return false;
    const OwnedScan& scan = scans_[next_];
    sweep.header.sequence = next_++;
    sweep.header.start_ns = scan.stamp_ns;
    sweep.header.end_ns = scan.stamp_ns + scan.duration_ns;
    sweep.header.num_columns = kScanColumns;
    sweep.header.rotation_rev = 1.0F;
    sweep.size = static_cast<std::uint32_t>(scan.points_m.size());
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      sweep.x_m[i] = scan.points_m[i].x(), sweep.y_m[i] = scan.points_m[i].y(),
      sweep.z_m[i] = scan.points_m[i].z();
      sweep.time_offset_ns[i] =
          static_cast<std::int32_t>(std::lround(static_cast<double>(scan.times_s[i]) * 1e9));
      if (!scan.rings.empty()) sweep.ring[i] = scan.rings[i];
    }
    if (scan.rings.empty()) {
      organizer_.organize(sweep);
    } else {
      organizer_.place_columns(sweep);
    }
    return true;
  }
  Progress progress() const noexcept override { return {}; }
  std::string complaint() const override { return {}; }

 private:
  const std::vector<OwnedScan>& scans_;
  std::size_t next_ = 0;
  ScanOrganizer organizer_{test::kStreetReturns};
};

std::vector<output::SweepRecord> run_pipeline(SweepSource& source) {
  struct : Observer {
    void on_sweep(const output::SweepRecord& record) override { records.push_back(record); }
    std::vector<output::SweepRecord> records;
  } observer;
  const std::atomic<bool> stop{false};
  Pipeline pipeline(Config{});
  const RunSummary summary = pipeline.run(source, observer, stop);
  REQUIRE(summary.failure.empty());
  return observer.records;
}

template <typename Numbers>
bool same_bytes(const Numbers& a, const Numbers& b) {
  return std::memcmp(a.data(), b.data(), sizeof(Numbers)) == 0;
}

/// To the last bit.
void check_same(const Estimate& estimate, const output::SweepRecord& record) {
  CHECK(estimate.stamp_ns == record.stamp_ns);
  CHECK(same_bytes(output::to_row(estimate.T_odom_sensor_front_end), record.T_odom_sensor_front_end));
  CHECK(same_bytes(output::to_row(estimate.T_odom_sensor_first), record.T_odom_sensor_first));
  CHECK(same_bytes(output::to_row(estimate.T_odom_sensor_refined), record.T_odom_sensor_refined));
  const Matrix6d transposed = estimate.covariance.transpose();  // row by row in the record
  CHECK(std::memcmp(transposed.data(), record.covariance.data(), sizeof record.covariance) == 0);
  CHECK(estimate.has_pose == record.has_pose);
  CHECK((estimate.health == record.health && estimate.reason == record.reason));
  CHECK((estimate.edge_matches == record.edge_matches && estimate.planar_matches == record.planar_matches));
}

/// A KITTI folder through the pipeline, and its files as plain points through the library call.
void check_folder(const std::filesystem::path& folder, std::size_t num_scans) {
  KittiSource source(folder);
  const auto records = run_pipeline(source);
  const auto files = test::kitti_scans(folder / "velodyne");
  REQUIRE(files.size() == num_scans);
  REQUIRE(records.size() == num_scans);
  Odometry odometry;
  Sweep file(200'000);
  for (std::size_t i = 0; i < num_scans; ++i) {
    INFO("scan " << i);
    test::load_kitti_points(files[i], file);
    OwnedScan scan;
    for (std::uint32_t k = 0; k < file.size; ++k)
      scan.points_m.emplace_back(file.x_m[k], file.y_m[k], file.z_m[k]);
    scan.stamp_ns = records[i].header.start_ns;
    scan.duration_ns = records[i].header.end_ns - records[i].header.start_ns;
    check_same(odometry.process(scan.view()), records[i]);
    CHECK(records[i].has_pose);
    REQUIRE(odometry.ground().size() == file.size);
    CHECK(std::ranges::count(odometry.ground(), kGround) == records[i].num_ground);
  }
  CHECK(odometry.points_left_out() == source.returns_without_cell());
  CHECK(odometry.scans_with_guessed_rings() == source.scans_with_guessed_rings());
}

}  // namespace

TEST_CASE("KITTI's scans get the poses that the pipeline gives them", "[pipeline][library]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/odometry_00_000000-000015");
  check_folder(folder, 16);
}

TEST_CASE("a folder of street scans gets the poses that the pipeline gives it", "[pipeline][library]") {
  const test::TemporaryPath root("_kitti");
  std::filesystem::create_directories(root.path() / "velodyne");
  std::ofstream times(root.path() / "times.txt");
  const test::Street street;
  for (int i = 0; i < 4; ++i) {
    Sweep sweep(test::kStreetReturns);
    street.scan(test::street_start() * exp_se3(drive_twist() * (0.1 * i)), Vector6d::Zero(), i * kPeriod_ns,
                0.01, sweep);
    std::ofstream file(root.path() / "velodyne" / (std::to_string(i) + ".bin"), std::ios::binary);
    for (std::uint32_t k = 0; k < sweep.size; ++k) {
      const float point[] = {sweep.x_m[k], sweep.y_m[k], sweep.z_m[k], 0.5F};
      file.write(reinterpret_cast<const char*>(point), sizeof point);
    }
    times << 0.1 * i << '\n';
  }
  times.close();
  check_folder(root.path(), 4);
}

TEST_CASE("timed scans get the pipeline's poses, with rings and without", "[pipeline][library]") {
  std::vector<OwnedScan> scans = street_drive(5);
  for (const bool has_rings : {true, false}) {
    INFO("rings known: " << has_rings);
    for (OwnedScan& scan : scans)
      if (!has_rings) scan.rings.clear();
    MemoryScans source(scans);
    const auto records = run_pipeline(source);
    REQUIRE(records.size() == scans.size());
    Odometry odometry;
    for (std::size_t i = 0; i < scans.size(); ++i) check_same(odometry.process(scans[i].view()), records[i]);
    CHECK(odometry.scans_with_guessed_rings() == (has_rings ? 0 : scans.size()));
    // The street's lasers are evenly spaced, KITTI's are not: where two fall into one ring, some are left
    // out.
    CHECK((odometry.points_left_out() == 0) == has_rings);
  }
}

TEST_CASE("a drive along the street comes out as it was driven", "[pipeline][library]") {
  Odometry odometry;
  Estimate last;
  for (const OwnedScan& scan : street_drive(6)) last = odometry.process(scan.view());
  REQUIRE(last.has_pose);
  CHECK(last.health == Health::kOk);
  CHECK(last.stamp_ns == 6 * kPeriod_ns);
  const Eigen::Isometry3d T_true =
      exp_se3(drive_twist() * 0.5);  // from the end of the first to that of the last
  CHECK((last.T_odom_sensor_refined.translation() - T_true.translation()).norm() < 0.08);
  CHECK(log_se3(last.T_odom_sensor_refined)[5] == Approx(0.05).margin(0.005));
}

TEST_CASE("the ground mask has a byte per point, no returns included", "[pipeline][library]") {
  OwnedScan scan = street_scan(0, Vector6d::Zero());
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (std::size_t i = 0; i < 1000; ++i) scan.points_m[100 * i].setConstant(i % 2 == 0 ? nan : 0.0F);
  Odometry odometry;
  CHECK(odometry.ground().empty());
  CHECK(odometry.process(scan.view()).has_pose);
  REQUIRE(odometry.ground().size() == scan.points_m.size());
  std::size_t right = 0, judged = 0;
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    const Eigen::Vector3f& p = scan.points_m[i];
    if (!p.allFinite() || p.isZero() || p.head<2>().norm() > 40.0F) continue;
    ++judged;
    right += (odometry.ground()[i] == kGround) == (p.z() < -1.6F) ? 1U : 0U;
  }
  CHECK(static_cast<double>(right) > 0.97 * static_cast<double>(judged));
}

TEST_CASE("a scan that cannot be used is refused with a reason and leaves no trace", "[pipeline][library]") {
  const std::vector<OwnedScan> scans = street_drive(3);
  Odometry odometry, undisturbed;
  for (const OwnedScan& scan : scans) {
    const auto expect_refusal = [&](const std::string& words, auto spoil) {
      OwnedScan bad = scan;
      spoil(bad);
      const Estimate estimate = odometry.process(bad.view());
      INFO(words);
      CHECK_FALSE(estimate.has_pose);
      CHECK(estimate.reason == HealthReason::kRefusedScan);
      CHECK(estimate.health == Health::kLost);
      CHECK_THAT(std::string(odometry.refusal()), Catch::Contains(words));
      CHECK(odometry.ground().empty());
    };
    expect_refusal("more points", [&](OwnedScan& s) { s.points_m.resize(odometry.max_points() + 1); });
    expect_refusal("times_s", [](OwnedScan& s) { s.times_s.pop_back(); });
    expect_refusal("rings", [](OwnedScan& s) { s.rings.push_back(1); });
    expect_refusal("ring is above 63", [](OwnedScan& s) { s.rings[7] = 64; });
    for (const float time_s : {2.1F, -3.0F, 1e9F, std::numeric_limits<float>::quiet_NaN()})
      expect_refusal("a time", [&](OwnedScan& s) { s.times_s.back() = time_s; });
    for (const std::int64_t duration_ns : {std::int64_t{-1}, std::int64_t{1'000'000'001}})
      expect_refusal("duration_ns", [&](OwnedScan& s) { s.duration_ns = duration_ns; });
    for (const std::int64_t stamp_ns :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
      expect_refusal("stamp_ns", [&](OwnedScan& s) { s.stamp_ns = stamp_ns; });

    const Estimate estimate = odometry.process(scan.view()), expected = undisturbed.process(scan.view());
    CHECK(odometry.refusal().empty());
    CHECK(same_bytes(output::to_row(estimate.T_odom_sensor_refined),
                     output::to_row(expected.T_odom_sensor_refined)));
    CHECK(estimate.health == expected.health);
  }
}

/// Until then the first motion is being sought.
constexpr int kStart_sweeps = 8;

TEST_CASE("scans without points are carried over by the motion so far", "[pipeline][library]") {
  Odometry odometry;
  Estimate last;
  for (const OwnedScan& scan : street_drive(kStart_sweeps)) last = odometry.process(scan.view());
  OwnedScan empty;
  empty.stamp_ns = kStart_sweeps * kPeriod_ns;
  const Estimate carried = odometry.process(empty.view());
  CHECK(carried.has_pose);
  CHECK(carried.health == Health::kDegraded);
  const Eigen::Isometry3d T_step = last.T_odom_sensor_refined.inverse() * carried.T_odom_sensor_refined;
  CHECK(T_step.translation().x() ==
        Approx(0.8 - 0.4).margin(0.05));  // to the middle: an empty scan has no times
}

TEST_CASE("a clock that begins anew costs trust but not the pose", "[pipeline][library]") {
  Odometry odometry;
  Estimate last;
  for (const OwnedScan& scan : street_drive(kStart_sweeps)) last = odometry.process(scan.view());
  OwnedScan next = street_scan(kStart_sweeps, drive_twist());
  next.stamp_ns = 0;
  const Estimate after = odometry.process(next.view());
  CHECK(after.has_pose);
  CHECK(after.reason == HealthReason::kTimeGap);
  const Eigen::Isometry3d T_last_after = last.T_odom_sensor_refined.inverse() * after.T_odom_sensor_refined;
  CHECK(T_last_after.translation().x() == Approx(0.8).margin(0.1));
}

TEST_CASE("processing neither allocates nor frees", "[pipeline][library]") {
  const std::vector<OwnedScan> scans = street_drive(3);
  Scan compensated = scans[2].view();
  compensated.times_s = {}, compensated.rings = {};
  compensated.stamp_ns += kPeriod_ns;
  Odometry odometry;
  const test::AllocationGuard guard;
  for (const OwnedScan& scan : scans) odometry.process(scan.view());
  odometry.process(compensated);
  compensated.duration_ns = -1;
  odometry.process(compensated);  // refused
  const std::uint64_t heap_calls = guard.count();
  const Odometry planted;
  CHECK(guard.count() > heap_calls);
  CHECK(heap_calls == 0);
  CHECK_FALSE(odometry.refusal().empty());
}

TEST_CASE("settings that cannot be used are refused when the odometry is made", "[pipeline][library]") {
  Config config;
  config.ground.method = "lawn";
  CHECK_THROWS_AS(Odometry(config), Error);
  config.ground.method = "truth";
  CHECK_THROWS_WITH(Odometry(config), Catch::Contains("needs labels"));
  config = {};
  config.odometry.max_rounds = 0;
  CHECK_THROWS_WITH(Odometry(config), Catch::Contains("odometry.max_rounds"));
}
