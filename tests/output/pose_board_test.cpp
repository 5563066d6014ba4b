// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/pose_board.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::output;

namespace {

std::string own_name() {
  return "pago_test_" + std::to_string(getpid());
}

PoseV1 pose(PoseKind kind, std::uint64_t sequence) {
  PoseV1 p{};
  p.magic = PAGO_POSE_V1;
  p.kind = static_cast<std::uint8_t>(kind);
  p.sequence = sequence;
  p.position_m[0] = static_cast<double>(sequence);
  return p;
}

/// A reader's side, as a C program has it.
class Reader {
 public:
  explicit Reader(const std::string& name) : fd_(shm_open(("/" + name).c_str(), O_RDONLY, 0)) {
    if (fd_ >= 0)
      board_ = static_cast<const pago_pose_board_v1*>(
          mmap(nullptr, sizeof(pago_pose_board_v1), PROT_READ, MAP_SHARED, fd_, 0));
  }
  ~Reader() {
    if (fd_ < 0) return;
    munmap(const_cast<pago_pose_board_v1*>(board_), sizeof(pago_pose_board_v1));
    close(fd_);
  }
  bool is_open() const { return fd_ >= 0; }
  const pago_pose_board_v1& board() const { return *board_; }

 private:
  int fd_;
  const pago_pose_board_v1* board_ = nullptr;
};

/// A sweep whose estimate moves ahead and turns left, with the sensor tilted on its mount.
Sweep moving_sweep() {
  Sweep sweep(1);
  sweep.header.sequence = 12;
  sweep.header.last_arrival_ns = 77;
  Estimate& e = sweep.estimate;
  e.has_pose = true;
  e.health = Health::kDegraded;
  e.reason = HealthReason::kIncompleteSweep;
  e.stamp_ns = 55;
  e.T_odom_sensor_first.translation() = Eigen::Vector3d(1.0, 0.0, 0.0);
  e.T_odom_sensor_refined.translation() = Eigen::Vector3d(2.0, 0.0, 0.0);
  e.twist << 10.0, 0.0, 0.0, 0.0, 0.0, 0.5;
  e.covariance = Matrix6d::Identity();
  return sweep;
}

}  // namespace

TEST_CASE("the newest pose of each kind is there for this process", "[output][pose_board]") {
  PoseBoard board("");
  PoseV1 seen{};
  CHECK_FALSE(board.newest(PoseKind::kFirst, seen));
  board.publish(pose(PoseKind::kFirst, 1));
  board.publish(pose(PoseKind::kFirst, 2));
  board.publish(pose(PoseKind::kRefined, 1));
  REQUIRE(board.newest(PoseKind::kFirst, seen));
  CHECK(seen.sequence == 2);
  REQUIRE(board.newest(PoseKind::kRefined, seen));
  CHECK(seen.sequence == 1);
}

TEST_CASE("another process reads poses from shared memory, and sees that they are new",
          "[output][pose_board]") {
  PoseBoard board(own_name());
  const Reader reader(own_name());
  REQUIRE(reader.is_open());
  CHECK(reader.board().magic == PAGO_POSE_V1);
  CHECK(reader.board().news == 0);
  PoseV1 seen{};
  CHECK(pago_read_pose_v1(&reader.board().refined, &seen) == 0);
  board.publish(pose(PoseKind::kRefined, 41));
  CHECK(reader.board().news == 1);
  REQUIRE(pago_read_pose_v1(&reader.board().refined, &seen) == 1);
  CHECK(seen.sequence == 41);
  CHECK(seen.position_m[0] == 41.0);
  CHECK(pago_read_pose_v1(&reader.board().first, &seen) == 0);
}

TEST_CASE("the documentation's C program prints each refined pose once", "[output][pose_board]") {
  auto board = std::make_unique<PoseBoard>(own_name());
  std::FILE* const reader = popen((POSE_READER " " + own_name()).c_str(), "r");
  REQUIRE(reader != nullptr);
  std::vector<std::string> lines;
  std::array<char, 256> line{};
  for (std::uint64_t sequence = 10; sequence < 13; ++sequence) {
    board->publish(pose(PoseKind::kRefined, sequence));
    board->publish(pose(PoseKind::kFirst, sequence + 1));
    REQUIRE(std::fgets(line.data(), line.size(), reader) != nullptr);
    lines.emplace_back(line.data());
  }
  board.reset();
  CHECK(std::fgets(line.data(), line.size(), reader) == nullptr);
  CHECK(pclose(reader) == 0);
  for (std::size_t i = 0; i < lines.size(); ++i)
    CHECK_THAT(lines[i], Catch::StartsWith(std::to_string(10 + i) + " ") &&
                             Catch::Contains("at 1" + std::to_string(i)));
}

TEST_CASE("a board has one owner, a dead owner's board is taken over, empty", "[output][pose_board]") {
  const pid_t child = fork();
  if (child == 0) {
    PoseBoard* const left_behind = new PoseBoard(own_name() + "_dead");
    left_behind->publish(pose(PoseKind::kFirst, 1));
    _exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  const std::string name = "pago_test_" + std::to_string(child) + "_dead";
  const Reader old_reader(name);
  REQUIRE(old_reader.is_open());
  CHECK(old_reader.board().magic == PAGO_POSE_V1);
  {
    const PoseBoard board(name);
    PoseV1 seen{};
    CHECK_FALSE(board.newest(PoseKind::kFirst, seen));
    CHECK_THROWS_WITH(PoseBoard(name), Catch::Contains("another running process publishes there"));
    CHECK(old_reader.board().magic == 0);
    CHECK(Reader(name).board().magic == PAGO_POSE_V1);
  }
  CHECK_FALSE(Reader(name).is_open());
  CHECK_THROWS_AS(PoseBoard("a/b"), Error);
}

TEST_CASE("a pose of the sensor is passed on as it is", "[output][pose_board]") {
  const Sweep sweep = moving_sweep();
  const PoseV1 p = PoseMaker(PoseChild::kSensor, Mount{}).make(sweep, PoseKind::kRefined);
  CHECK(p.magic == PAGO_POSE_V1);
  CHECK(p.kind == PAGO_POSE_REFINED);
  CHECK(p.health == PAGO_HEALTH_DEGRADED);
  CHECK(p.reason == static_cast<int>(HealthReason::kIncompleteSweep));
  CHECK(p.sequence == 12);
  CHECK(p.stamp_ns == 55);
  CHECK(p.last_arrival_ns == 77);
  CHECK(std::string(p.frame_id) == "odom");
  CHECK(std::string(p.child_frame_id) == "sensor");
  CHECK(p.position_m[0] == 2.0);
  CHECK(p.orientation_xyzw[3] == 1.0);
  CHECK(p.twist[0] == 10.0);
  CHECK(p.covariance[0] == 1.0);
}

TEST_CASE("a pose of base_link is that of the vehicle, however the sensor sits on it",
          "[output][pose_board]") {
  // Sensor 2 m up, turned to the left by a quarter: the vehicle's ahead is the sensor's right.
  Mount mount;
  mount.height_m = 2.0;
  mount.yaw_rad = std::numbers::pi / 2.0;
  Sweep sweep = moving_sweep();
  const Vector6d base_motion = (Vector6d() << 3.0, 0.0, 0.0, 0.0, 0.0, 0.2).finished();
  const Eigen::Isometry3d T_bs = mount.T_base_sensor();
  sweep.estimate.T_odom_sensor_first = T_bs.inverse() * exp_se3(base_motion) * T_bs;
  sweep.estimate.twist = adjoint(T_bs.inverse()) * base_motion;
  const PoseV1 p = PoseMaker(PoseChild::kBaseLink, mount).make(sweep, PoseKind::kFirst);
  const Eigen::Isometry3d expected = exp_se3(base_motion);
  CHECK(std::string(p.child_frame_id) == "base_link");
  for (int i = 0; i < 3; ++i) CHECK(p.position_m[i] == Approx(expected.translation()[i]).margin(1e-12));
  CHECK(p.orientation_xyzw[2] == Approx(std::sin(0.1)));
  CHECK(p.orientation_xyzw[3] == Approx(std::cos(0.1)));
  for (int i = 0; i < 6; ++i) CHECK(p.twist[i] == Approx(base_motion[i]).margin(1e-12));
  // A turn of the sensor about its own axis moves base_link below it not at all; about its x axis it does.
  CHECK(p.covariance[5 * 6 + 5] == Approx(1.0));
  CHECK(p.covariance[0] == Approx(1.0 + 4.0));
}
