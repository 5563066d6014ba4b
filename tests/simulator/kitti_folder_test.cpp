// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <atomic>
#include <cmath>
#include <fstream>

#include "drivers/simulator/surface.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/ground_metrics.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/simulator/packet_labels.hpp"
#include "pago/simulator/render.hpp"
#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
namespace fs = std::filesystem;

namespace {

Config short_drive() {
  Config config;
  config.simulator.seconds = 0.4;
  config.simulator.start_speed_m_s = 11.0;
  return config;
}

std::uint64_t render_to(const Config& config, const simulator::DriveFiles& files) {
  const std::atomic<bool> stop{false};
  return simulator::render(
      config, files, [](const Progress&) {}, stop);
}

/// How far the walls' points of one scan lie from the nearest ones of another, in the median.
struct Scan {
  std::vector<Eigen::Vector3d> points;
  std::vector<std::uint32_t> labels;
};

Scan read_scan(KittiSource& source, const fs::path& labels) {
  Sweep sweep(200'000);
  REQUIRE(source.fill(sweep));
  Scan scan;
  scan.labels = evaluation::read_semantic_labels(labels, sweep.size);
  for (std::uint32_t i = 0; i < sweep.size; ++i)
    scan.points.push_back(Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>());
  return scan;
}

double median_distance_m(const Scan& a, const Scan& b, const Eigen::Isometry3d& T_b_a) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < a.points.size(); i += 97) {
    if (a.labels[i] != static_cast<std::uint32_t>(simulator::Label::kBuilding) || a.points[i].norm() > 20.0)
      continue;
    const Eigen::Vector3d p = T_b_a * a.points[i];
    double nearest = 1e9;
    for (std::size_t k = 0; k < b.points.size(); ++k)
      if (b.labels[k] == a.labels[i]) nearest = std::min(nearest, (b.points[k] - p).squaredNorm());
    distances.push_back(std::sqrt(nearest));
  }
  REQUIRE(distances.size() > 50);
  std::ranges::sort(distances);
  return distances[distances.size() / 2];
}

}  // namespace

TEST_CASE("a rendered KITTI folder is one for PaGO's reader, with a label per point", "[simulator][kitti]") {
  const test::TemporaryPath folder("");
  simulator::DriveFiles files;
  files.kitti = folder.path();
  files.pictures = folder.path() / "pictures";
  files.kitti_compensated = true;
  REQUIRE(render_to(short_drive(), files) == 4);
  for (const char* name : {"bird.png", "classes.png", "ranges.png", "intensities.png"})
    CHECK(fs::file_size(files.pictures / name) > 3000);

  KittiSource source(folder.path());
  CHECK(source.is_compensated());
  CHECK(source.has_stamps());
  const auto labels = [&](int i) {
    return folder.path() / "labels" / ("00000" + std::to_string(i) + ".label");
  };
  const Scan first = read_scan(source, labels(0)), second = read_scan(source, labels(1));
  CHECK(source.scans_with_guessed_rings() == 0);

  evaluation::Trajectory poses = evaluation::read_trajectory(folder.path() / "poses.txt");
  REQUIRE(poses.poses.size() == 4);
  CHECK(poses.poses[0].T_world_sensor.isApprox(Eigen::Isometry3d::Identity()));
  evaluation::camera_to_sensor(poses, evaluation::read_kitti_calibration(folder.path() / "calib.txt"));
  const Eigen::Isometry3d T_second_first =
      poses.poses[1].T_world_sensor.inverse() * poses.poses[0].T_world_sensor;
  CHECK(T_second_first.translation().x() == Approx(-1.1).margin(0.2));
  // Compensated scans fit onto each other; the points of a wall are some centimetres apart.
  CHECK(median_distance_m(first, second, T_second_first) < 0.06);
}

TEST_CASE("a folder with scans is not written into, and a truth that cannot be written is told first",
          "[simulator][kitti]") {
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path() / "velodyne");
  std::ofstream(folder.path() / "velodyne" / "000050.bin") << "of a longer drive";
  simulator::DriveFiles scans, packets;
  scans.kitti = folder.path();
  REQUIRE_THROWS_WITH(render_to(short_drive(), scans), Catch::Contains("holds scans already"));
  CHECK(fs::exists(folder.path() / "velodyne" / "000050.bin"));

  packets.pcap = folder.path() / "drive.pcap";
  packets.truth = folder.path() / "missing" / "x.tum";
  REQUIRE_THROWS_AS(render_to(short_drive(), packets), Error);
  CHECK(!fs::exists(packets.pcap));
}

TEST_CASE("packets, labels, calibration and truth are written side by side", "[simulator][kitti]") {
  const test::TemporaryPath folder("");
  fs::create_directories(folder.path());
  const simulator::DriveFiles files = simulator::files_in(folder.path());
  REQUIRE(render_to(short_drive(), files) == 4);
  const auto packets = test::read_capture(files.pcap);
  const simulator::LabelTrack labels(files.labels);
  REQUIRE(packets.size() == labels.size());
  REQUIRE(packets.size() >= 1389);
  CHECK(packets[0].payload.size() == hdl64::kPacketBytes);
  CHECK(hdl64::load_calibration(files.calibration, VerticalOffset::kVertical).two_point);
  const evaluation::Trajectory truth = evaluation::read_trajectory(files.truth);
  CHECK(truth.poses.size() == 81);
  for (const char* name : {"truth_start.txt", "truth_mid.txt", "truth_end.txt"})
    CHECK(evaluation::read_trajectory(folder.path() / name).poses.size() == 4);
  // Where one sweep ends the next begins.
  const auto start = evaluation::read_trajectory(folder.path() / "truth_start.txt");
  const auto end = evaluation::read_trajectory(folder.path() / "truth_end.txt");
  CHECK(start.poses[1].T_world_sensor.isApprox(end.poses[0].T_world_sensor));
}
