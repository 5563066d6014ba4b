// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/trajectory_writer.hpp"

#include <random>
#include <sstream>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::output;
using Catch::Matchers::Contains;
using pago::test::contents;
using pago::test::ScratchFolder;

PoseRow random_pose(std::mt19937& random) {
  std::normal_distribution<double> normal;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized());
  T.translation() = 1e3 * Eigen::Vector3d(normal(random), normal(random), normal(random));
  return to_row(T);
}

TEST_CASE("a KITTI line gives the same doubles back", "[output][trajectory_writer]") {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const PoseRow pose = random_pose(random);
    std::istringstream line(kitti_line(pose));
    for (const double number : pose) {
      std::string word;
      line >> word;
      CHECK(std::stod(word) == number);
    }
    std::string rest;
    CHECK_FALSE(line >> rest);
  }
}

TEST_CASE("stamps are exact to the nanosecond", "[output][trajectory_writer]") {
  const auto stamp_of = [](std::int64_t ns) {
    const std::string line = tum_line(ns, kIdentityRow);
    return line.substr(0, line.find(' '));
  };
  CHECK(stamp_of(1'317'378'034'123'456'789) == "1317378034.123456789");
  CHECK(stamp_of(0) == "0.000000000");
  CHECK(stamp_of(5) == "0.000000005");
  CHECK(stamp_of(-1'500'000'000) == "-1.500000000");
  CHECK(stamp_of(-5) == "-0.000000005");
}

TEST_CASE("both files read back as the poses that were written", "[output][trajectory_writer]") {
  const ScratchFolder scratch;
  std::mt19937 random(2);
  std::vector<PoseRow> poses;
  TrajectoryWriter writer(scratch.path, "odometry");
  for (std::int64_t i = 0; i < 100; ++i) {
    poses.push_back(random_pose(random));
    writer.write(1'317'378'034'000'000'001 + 100'000'000 * i, poses.back());
  }
  writer.flush();
  CHECK(writer.complaint().empty());

  const auto kitti = pago::evaluation::read_trajectory(scratch.path / "odometry.kitti");
  const auto tum = pago::evaluation::read_trajectory(scratch.path / "odometry.tum");
  REQUIRE(kitti.poses.size() == 100);
  REQUIRE(tum.poses.size() == 100);
  CHECK(tum.poses[3].stamp_ns == 1'317'378'034'300'000'001);
  for (std::size_t i = 0; i < 100; ++i) {
    const Eigen::Matrix4d written = to_isometry(poses[i]).matrix();
    CHECK((kitti.poses[i].T_world_sensor.matrix() - written).norm() < 1e-13);
    CHECK((tum.poses[i].T_world_sensor.matrix() - written).norm() < 1e-9);
  }
}

TEST_CASE("what was flushed is on the disk while the writer goes on", "[output][trajectory_writer]") {
  const ScratchFolder scratch;
  TrajectoryWriter writer(scratch.path, "odometry");
  writer.write(0, kIdentityRow);
  writer.flush();
  CHECK(contents(scratch.path / "odometry.kitti") == kitti_line(kIdentityRow));
  CHECK(contents(scratch.path / "odometry.tum") == tum_line(0, kIdentityRow));
}

TEST_CASE("a full disk is a complaint with the file's name, not an end", "[output][trajectory_writer]") {
  const ScratchFolder scratch;
  std::filesystem::create_symlink("/dev/full", scratch.path / "odometry.kitti");
  TrajectoryWriter writer(scratch.path, "odometry");
  for (int i = 0; i < 1000; ++i) writer.write(i, kIdentityRow);
  writer.flush();
  CHECK_THAT(writer.complaint(), Contains("odometry.kitti: cannot be written: No space left"));
  // The other file is whole.
  CHECK(pago::evaluation::read_trajectory(scratch.path / "odometry.tum").poses.size() == 1000);
}

TEST_CASE("a folder that is not there is refused by name", "[output][trajectory_writer]") {
  CHECK_THROWS_WITH(TrajectoryWriter("no/such/folder", "odometry"),
                    Contains("no/such/folder/odometry.tum: cannot be made"));
}

TEST_CASE("whole files on a full disk are an Error", "[output][text_file]") {
  CHECK_THROWS_WITH(write_file("/dev/full", "text"), Contains("/dev/full: cannot be written: No space left"));
}

TEST_CASE("a file in the place of a folder is named", "[output][text_file]") {
  const ScratchFolder scratch;
  write_file(scratch.path / "file", "text");
  CHECK_THROWS_WITH(make_folders(scratch.path / "file"), Contains("file: the folder cannot be made"));
  CHECK_THROWS_WITH(make_folders(scratch.path / "file" / "below"), Contains("the folder cannot be made"));
  make_folders(scratch.path / "a" / "b");
  CHECK(std::filesystem::is_directory(scratch.path / "a" / "b"));
}

}  // namespace
