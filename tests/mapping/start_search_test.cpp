// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/start_search.hpp"

#include "pago/core/se3.hpp"
#include "support/catch.hpp"
#include "support/street_drive.hpp"

using namespace pago;
using test::forward;
using test::StreetDrive;

TEST_CASE("switched on at any speed, the motion is found within a few sweeps", "[mapping][start]") {
  for (const Vector6d& speed :
       {forward(0.0), forward(-3.0), forward(7.5, 0.3), forward(17.0), forward(26.0)}) {
    StreetDrive drive;
    const Eigen::Isometry3d T_world_start = drive.T_world_start;
    int sweeps = 0;
    while (sweeps < 9 && drive.sweep.estimate.health == Health::kInit) drive.next(speed), ++sweeps;
    drive.next(speed);
    INFO("speed " << speed[0] << ", found " << drive.sweep.estimate.twist.transpose() << " after " << sweeps);
    REQUIRE(drive.sweep.estimate.health == Health::kOk);
    REQUIRE((drive.sweep.estimate.twist - speed).head<3>().norm() < 0.3);
    REQUIRE((drive.sweep.estimate.twist - speed).tail<3>().norm() < 0.05);
    const Eigen::Isometry3d T_first_last = drive.T_first_last(T_world_start * exp_se3(0.1 * speed));
    REQUIRE((T_first_last.inverse() * drive.refined()).translation().norm() < 0.06);
  }
}

TEST_CASE("without a search the sensor is taken to stand", "[mapping][start]") {
  MappingConfig config;
  config.start.search = false;
  StreetDrive drive({}, config);
  drive.next(Vector6d::Zero());
  REQUIRE(drive.next(Vector6d::Zero()).health == Health::kOk);
}
