// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// compensate FOLDER OUT: a drive of packets (packets.pcap, calibration.xml, poses_start.txt, poses_mid.txt,
// poses_end.txt) as KITTI scans whose returns are all in the frame of the sweep's middle, moved there by the
// truth. Of the lab's drives, which stand there as packets only, it makes what the paper's systems were
// measured on.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <numbers>
#include <vector>

#include "pago/core/se3.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/sweep_reader.hpp"

using namespace pago;
namespace fs = std::filesystem;

namespace {

struct Truth {
  explicit Truth(const fs::path& folder)
      : start(evaluation::read_trajectory(folder / "poses_start.txt")),
        mid(evaluation::read_trajectory(folder / "poses_mid.txt")),
        end(evaluation::read_trajectory(folder / "poses_end.txt")) {}

  /// From the sensor at a part of sweep `row` to the sensor in its middle.
  Eigen::Isometry3d T_mid_sensor(std::size_t row, double part) const {
    const auto pose = [&](const evaluation::Trajectory& t) { return t.poses[row].T_world_sensor; };
    const Eigen::Isometry3d T_world_sensor = part < 0.5 ? interpolate(pose(start), pose(mid), 2.0 * part)
                                                        : interpolate(pose(mid), pose(end), 2.0 * part - 1.0);
    return pose(mid).inverse() * T_world_sensor;
  }

  evaluation::Trajectory start, mid, end;
};

using Point = std::array<float, 4>;

/// KITTI's order: ring by ring from the top, each by rising azimuth from straight ahead.
std::vector<Point> in_order_of_kitti(std::array<std::vector<Point>, kNumRings>& rings) {
  const auto azimuth = [](const Point& p) {
    const float angle = std::atan2(p[1], p[0]);
    return angle < 0.0F ? angle + 2.0F * std::numbers::pi_v<float> : angle;
  };
  std::vector<Point> points;
  for (std::size_t ring = kNumRings; ring-- > 0;) {
    std::ranges::sort(rings[ring], {}, azimuth);
    points.insert(points.end(), rings[ring].begin(), rings[ring].end());
  }
  return points;
}

std::vector<Point> compensated(const Sweep& sweep, const Truth& truth, std::size_t row) {
  std::array<std::vector<Point>, kNumRings> rings;
  const double duration_ns = static_cast<double>(sweep.header.end_ns - sweep.header.start_ns);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Isometry3d T = truth.T_mid_sensor(row, sweep.time_offset_ns[i] / duration_ns);
    const Eigen::Vector3f p =
        (T * Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>()).cast<float>();
    rings[sweep.ring[i]].push_back({p.x(), p.y(), p.z(), static_cast<float>(sweep.intensity[i]) / 255.0F});
  }
  return in_order_of_kitti(rings);
}

void write(const std::vector<Point>& points, const fs::path& file) {
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(points.data()),
            static_cast<std::streamsize>(points.size() * sizeof(Point)));
  if (!out) throw std::runtime_error(file.string() + " cannot be written");
}

std::size_t compensate(const fs::path& folder, const fs::path& out) {
  Config config;
  config.hdl64.vertical_offset = VerticalOffset::kPerpendicular;
  const Truth truth(folder);
  const auto calibration = hdl64::load_calibration(folder / "calibration.xml", config.hdl64.vertical_offset);
  PcapSource packets(folder / "packets.pcap", config.packets, config.capture);
  SweepReader reader(config, packets, calibration);
  fs::create_directories(out / "velodyne");
  std::ofstream times(out / "times.txt");
  std::size_t row = 0;
  for (Sweep* sweep = nullptr; (sweep = reader.next()) != nullptr;) {
    if (!sweep->header.is_posed() || row == truth.mid.poses.size()) continue;
    write(compensated(*sweep, truth, row), out / "velodyne" / format("%06zu.bin", row));
    times << std::setprecision(9) << 0.1 * static_cast<double>(row++) << '\n';
  }
  return row;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "compensate FOLDER OUT\n";
    return 2;
  }
  try {
    std::cout << compensate(argv[1], argv[2]) << " scans\n";
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
