// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
// pago_example SCAN.bin ...: KITTI scans in, a pose each out.
#include <cstdio>
#include <fstream>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "pago/pipeline/odometry.hpp"

std::vector<Eigen::Vector3f> read_points(const char* file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<Eigen::Vector3f> points_m;
  float point[4];  // x, y, z, intensity
  while (in.read(reinterpret_cast<char*>(point), sizeof point)) points_m.emplace_back(point);
  if (points_m.empty())
    throw pago::Error(file, "holds no points", "a .bin file of a KITTI sequence is needed");
  return points_m;
}

int main(int argc, char** argv) try {
  if (argc < 2) return std::puts("usage: pago_example 000000.bin 000001.bin ..."), 2;
  pago::Odometry odometry;
  for (int i = 1; i < argc; ++i) {
    const std::vector<Eigen::Vector3f> points_m = read_points(argv[i]);
    const pago::Estimate now = odometry.process({.points_m = points_m, .stamp_ns = i * 103'600'000LL});
    const Eigen::Vector3d at_m = now.T_odom_sensor_refined.translation();
    const double yaw_rad = pago::roll_pitch_yaw(now.T_odom_sensor_refined.linear()).yaw_rad;
    std::printf("x %7.3f  y %7.3f  z %7.3f m  yaw %8.5f rad  %s\n", at_m.x(), at_m.y(), at_m.z(), yaw_rad,
                to_string(now.health).data());
  }
  return 0;
} catch (const pago::Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
