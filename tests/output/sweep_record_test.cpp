// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/sweep_record.hpp"

#include "pago/core/spsc_queue.hpp"
#include "pago/output/trajectory_hash.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::output;

Eigen::Isometry3d awkward_pose() {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.rotate(Eigen::AngleAxisd(1.0 / 3.0, Eigen::Vector3d(1, 2, 3).normalized()));
  T.translation() = Eigen::Vector3d(0.1, -1e-300, 12345.678901234567);
  return T;
}

TEST_CASE("a record holds what the sweep said, to the last bit, after the sweep is recycled",
          "[output][sweep_record]") {
  Sweep sweep(100);
  sweep.header.sequence = 7;
  sweep.header.flags = kIncomplete;
  sweep.size = 60;
  for (std::uint32_t i = 0; i < 100; ++i) sweep.ground[i] = i < 25 || i >= 60 ? kGround : kNonGround;
  for (std::uint32_t i = 0; i < 4; ++i) sweep.features.edges.push_back(i);
  sweep.features.planars.push_back(1);
  sweep.estimate.stamp_ns = 123;
  sweep.estimate.T_odom_sensor_refined = awkward_pose();
  sweep.estimate.covariance(1, 4) = 42.0;
  sweep.estimate.health = Health::kDegraded;
  sweep.estimate.reason = HealthReason::kIncompleteSweep;
  sweep.estimate.has_pose = true;
  sweep.time_of(StageId::kOdometry) = {1, 2, 3};

  const SweepRecord record = make_record(sweep);
  sweep.reset();

  CHECK(record.header.sequence == 7);
  CHECK(record.header.has(kIncomplete));
  CHECK(record.num_returns == 60);
  CHECK(record.num_ground == 25);
  CHECK(record.num_edges == 4);
  CHECK(record.num_sharp_edges == 0);
  CHECK(record.num_planars == 1);
  CHECK(record.stamp_ns == 123);
  CHECK(to_isometry(record.T_odom_sensor_refined).matrix() == awkward_pose().matrix());
  CHECK(to_isometry(record.T_odom_sensor_first).matrix() == Eigen::Matrix4d::Identity());
  CHECK(record.covariance[1 * 6 + 4] == 42.0);
  CHECK(record.health == Health::kDegraded);
  CHECK(record.reason == HealthReason::kIncompleteSweep);
  CHECK(record.has_pose);
  CHECK(record.time_of(StageId::kOdometry).cpu_ns == 3);
}

TEST_CASE("records travel through a queue", "[output][sweep_record]") {
  SpscQueue<SweepRecord> queue(4);
  SweepRecord sent;
  sent.header.sequence = 9;
  CHECK(queue.try_push(sent));
  SweepRecord received;
  CHECK(queue.try_pop(received));
  CHECK(received.header.sequence == 9);
}

TEST_CASE("rows are KITTI's order", "[output][sweep_record]") {
  const PoseRow row = to_row(awkward_pose());
  CHECK(row[3] == 0.1);
  CHECK(row[7] == -1e-300);
  CHECK(row[1] == awkward_pose().linear()(0, 1));
  CHECK(to_row(Eigen::Isometry3d::Identity()) == kIdentityRow);
}

/// FNV-1a as its authors write it, over bytes.
std::uint64_t fnv1a(const std::string& bytes) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211ULL;
  return hash;
}

TEST_CASE("the hash is FNV-1a of the poses' bytes", "[output][trajectory_hash]") {
  // Test vectors of the FNV authors guard the reference itself.
  REQUIRE(fnv1a("") == 0xcbf29ce484222325ULL);
  REQUIRE(fnv1a("foobar") == 0x85944171f73967e8ULL);
  const PoseRow row = to_row(awkward_pose());
  TrajectoryHash hash;
  hash.add(row);
  hash.add(kIdentityRow);
  std::string bytes(reinterpret_cast<const char*>(row.data()), sizeof row);
  bytes.append(reinterpret_cast<const char*>(kIdentityRow.data()), sizeof kIdentityRow);
  CHECK(hash.value() == fnv1a(bytes));
  CHECK(TrajectoryHash{}.hex() == "cbf29ce484222325");
}

TEST_CASE("the hash sees the last bit, the sign of zero and the order", "[output][trajectory_hash]") {
  const auto hash_of = [](const std::vector<PoseRow>& rows) {
    TrajectoryHash hash;
    for (const PoseRow& row : rows) hash.add(row);
    return hash.hex();
  };
  const PoseRow a = to_row(awkward_pose());
  PoseRow last_bit = a, negative_zero = kIdentityRow;
  last_bit[3] = std::nextafter(a[3], 1.0);
  negative_zero[1] = -0.0;
  CHECK(hash_of({a}) != hash_of({last_bit}));
  CHECK(hash_of({kIdentityRow}) != hash_of({negative_zero}));
  CHECK(hash_of({a, kIdentityRow}) != hash_of({kIdentityRow, a}));
  CHECK(hash_of({a, a}) != hash_of({a}));
}

}  // namespace
