// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/recorded_path.hpp"

#include <cmath>
#include <fstream>
#include <functional>
#include <numbers>

#include "drivers/simulator/surroundings.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using namespace pago::simulator;
using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

/// Poses of a camera that looks along its way; `at` gives forward, left and up.
std::filesystem::path write_path(const test::TemporaryPath& file,
                                 int poses,
                                 const std::function<Vector3d(double t_s)>& at) {
  std::ofstream out(file.path());
  for (int i = 0; i < poses; ++i) {
    const Vector3d p = at(0.1 * i), ahead = at(0.1 * i + 0.1) - at(0.1 * i - 0.1);
    const double turn = ahead.norm() > 1e-6 ? std::atan2(ahead.y(), ahead.x()) : 0.0;  // to the left
    // Camera axes: x right, y down, z forward.
    out << std::cos(turn) << " 0 " << -std::sin(turn) << ' ' << -p.y() << " 0 1 0 " << -p.z() << ' '
        << std::sin(turn) << " 0 " << std::cos(turn) << ' ' << p.x() << '\n';
  }
  return file.path();
}

/// Three quarters of a lap too much around a circle of 60 m, ten metres per second, that climbs by 4 m a lap.
Vector3d climbing_circle(double t_s) {
  const double turn = t_s / 6.0;
  return {60.0 * std::sin(turn), 60.0 - 60.0 * std::cos(turn), 4.0 * turn / (2.0 * std::numbers::pi)};
}
constexpr int kCirclePoses = 600;

}  // namespace

TEST_CASE("a recorded path is followed in plan and in time", "[simulator][path]") {
  const test::TemporaryPath file("circle.txt");
  const RecordedPath path = read_path(write_path(file, kCirclePoses, climbing_circle), 4.0, 1.5);
  REQUIRE(static_cast<int>(path.distances_m.size()) == kCirclePoses);
  CHECK(path.duration_s() == Approx(59.9));
  double worst = 0.0;
  for (double t_s = 2.0; t_s < 57.0; t_s += 0.37) {
    // The scanner is 27 cm behind the camera.
    const Vector3d ahead = (climbing_circle(t_s + 0.1) - climbing_circle(t_s - 0.1)).normalized();
    const Vector2d there = (climbing_circle(t_s) - 0.27 * ahead).head<2>();
    worst = std::max(worst, (path.route.way.at(path.distance_m(t_s)) - there).norm());
  }
  CHECK(worst < 0.05);
}

TEST_CASE("where a path comes again, its heights agree and nothing is built twice", "[simulator][path]") {
  const test::TemporaryPath file("circle.txt");
  const RecordedPath path = read_path(write_path(file, kCirclePoses, climbing_circle), 4.0, 1.5);
  double worst = 0.0, steepest = 0.0;
  std::size_t again = 0;
  const auto& points = path.route.streets;
  const double lap_m = 2.0 * std::numbers::pi * 60.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    steepest = std::max(steepest, std::abs(points[i].grade));
    const double s = 2.0 * static_cast<double>(i);
    if (s < lap_m + 15.0) continue;
    ++again;
    CHECK_FALSE(points[i].is_furnished);
    for (std::size_t j = 0; j < i; ++j)
      if (s - 2.0 * static_cast<double>(j) > 100.0 && (points[i].at - points[j].at).norm() < 1.1)
        worst = std::max(worst, std::abs(points[i].z_m - points[j].z_m));
  }
  REQUIRE(again > 50);
  CHECK(worst < 0.05);
  CHECK(steepest < 0.03);
}

TEST_CASE("a path that stands still makes the vehicle stand", "[simulator][path]") {
  const test::TemporaryPath file("stop.txt");
  const auto at = [](double t_s) {
    const double moved_s = t_s < 5.0 ? t_s : std::max(5.0, t_s - 4.0);
    return Vector3d(8.0 * moved_s, 0.0, 0.0);
  };
  const RecordedPath path = read_path(write_path(file, 150, at), 4.0, 1.5);
  CHECK(path.distance_m(8.2) - path.distance_m(5.9) < 0.02);
  CHECK(path.distance_m(13.0) - path.distance_m(12.0) == Approx(8.0).margin(0.1));
  for (double t_s = 0.0; t_s < 14.0; t_s += 0.05)
    REQUIRE(path.distance_m(t_s + 0.05) >= path.distance_m(t_s) - 1e-9);
}

TEST_CASE("paths that cannot be driven along are refused, and settings they rule out", "[simulator][path]") {
  const test::TemporaryPath file("path.txt");
  const auto straight = [](double t_s) { return Vector3d(8.0 * t_s, 0.0, 0.0); };
  REQUIRE_THROWS_WITH(read_path(write_path(file, 5, straight), 4.0, 1.5), Catch::Contains("too short"));
  std::ofstream(file.path()) << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 0 0 1 0 0 0 0 1 -3\n";
  REQUIRE_THROWS_WITH(read_path(file.path(), 4.0, 1.5), Catch::Contains("backwards"));
  std::ofstream(file.path()) << "1.0 0 0 0 0 0 0 1\n2.0 3 0 0 0 0 0 1\n";
  REQUIRE_THROWS_WITH(read_path(file.path(), 4.0, 1.5), Catch::Contains("stamps"));
  // The sensor's poses, which look along x.
  std::ofstream(file.path()) << "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 3 0 1 0 0 0 0 1 0\n";
  REQUIRE_THROWS_WITH(read_path(file.path(), 4.0, 1.5), Catch::Contains(":2: drives sideways"));
  const auto jump = [](double t_s) { return Vector3d(8.0 * t_s + (t_s > 2.0 ? 20.0 : 0.0), 0.0, 0.0); };
  REQUIRE_THROWS_WITH(read_path(write_path(file, 100, jump), 4.0, 1.5),
                      Catch::Contains("is 20.8 m from the pose before"));

  SimulatorConfig config;
  config.path = write_path(file, 100, straight).string();
  config.path_first = 95;
  REQUIRE_THROWS_WITH(lay_out(config), Catch::Contains("path_first"));
  config.path_first = 0;
  config.loop_m = 1000.0;
  REQUIRE_THROWS_WITH(lay_out(config), Catch::Contains("loop_m"));
  config.loop_m = 0.0;
  config.path = "missing.txt";
  REQUIRE_THROWS_AS(lay_out(config), Error);
}

TEST_CASE("a recorded pace has no jerks", "[simulator][path]") {
  // 15 m/s, so that the poses are about as far apart as those that shape the way, each 2 cm off along it: as
  // they stand that is 6 m/s^2 from pose to pose.
  const test::TemporaryPath file("path.txt");
  const auto uneven = [](double t_s) {
    const double off_m = std::lround(10.0 * t_s) % 2 == 0 ? 0.02 : -0.02;
    return Vector3d(15.0 * t_s + off_m, 0.0, 0.0);
  };
  const RecordedPath path = read_path(write_path(file, 200, uneven), 4.0, 1.5);
  double hardest_m_s2 = 0.0;
  for (double t_s = 1.0; t_s < 18.8; t_s += 0.1) {
    const double change_m =
        path.distance_m(t_s + 0.1) - 2.0 * path.distance_m(t_s) + path.distance_m(t_s - 0.1);
    hardest_m_s2 = std::max(hardest_m_s2, std::abs(change_m) / 0.01);
  }
  CHECK(hardest_m_s2 < 0.3);
  CHECK(path.distance_m(15.0) - path.distance_m(5.0) == Approx(150.0).margin(0.05));
}

TEST_CASE("a drive along a path begins, ends and runs as the settings say", "[simulator][path]") {
  const test::TemporaryPath file("path.txt");
  SimulatorConfig config;
  config.world = SimulatedWorld::kField;
  config.path = write_path(file, 200, [](double t_s) { return Vector3d(8.0 * t_s, 0.0, 0.0); }).string();
  config.path_first = 50;
  config.speed = 2.0;
  config.seconds = 100.0;
  const Surroundings surroundings = lay_out(config);
  const Trajectory& drive = *surroundings.T_world_base;
  CHECK(drive.duration_s() == Approx(14.9 / 2.0).margin(0.05));
  CHECK(drive.pose(0.0).translation().x() == Approx(40.0 - 0.27).margin(0.1));
  CHECK((drive.pose(4.0).translation() - drive.pose(3.0).translation()).norm() == Approx(16.0).margin(0.1));
}

TEST_CASE("revisits of KITTI 00 and 02 agree in height", "[simulator][path][data]") {
  PAGO_DATA_OR_SKIP(poses, "kitti/poses");
  for (const char* sequence : {"00", "02"}) {
    const RecordedPath path = read_path(poses / (std::string(sequence) + ".txt"), 4.0, 1.5);
    const StreetMap map(path.route.streets);
    double worst = 0.0;
    std::size_t meetings = 0;
    for (std::size_t i = 0; i < map.points().size(); ++i) {
      const StreetPoint& here = map.points()[i];
      for (const std::uint32_t j : map.around(here.at)) {
        const StreetPoint& there = map.points()[j];
        if (j + 100 > i || (here.at - there.at).norm() > 1.5) continue;
        ++meetings;
        worst = std::max(worst, std::abs(here.z_m - there.z_m));
      }
    }
    INFO("sequence " << sequence << ", " << meetings << " meetings, worst " << worst << " m");
    CHECK(meetings > 100);
    CHECK(worst < 0.25);
  }
}
