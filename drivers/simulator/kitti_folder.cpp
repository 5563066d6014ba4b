// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_folder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "head.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/output/text_file.hpp"
#include "pago/output/trajectory_writer.hpp"

namespace pago::simulator {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

KittiFolderWriter::KittiFolderWriter(const Simulator& drive,
                                     const Hdl64Config& sensor,
                                     const std::filesystem::path& folder,
                                     bool is_compensated)
    : drive_(drive),
      decoder_(drive.calibration(), sensor.min_range_m, sensor.max_range_m),
      folder_(folder),
      is_compensated_(is_compensated) {
  output::make_folders(folder / "velodyne");
  output::make_folders(folder / "labels");
  T_mid_world_ = drive.T_world_sensor(drive.sweep(0).mid_ns).inverse();
}

void KittiFolderWriter::add(const SimulatedPacket& packet) {
  for (int firing = 0; firing < hdl64::kFirings; ++firing) {
    const std::int64_t time_ns = packet.time_ns + firing * hdl64::kFiringPeriod_ns;
    const auto scan = static_cast<std::uint64_t>(drive_.revolutions(time_ns) - Head::kStart_rev);
    if (scan != scan_) {
      write_scan();
      scan_ = scan;
      T_mid_world_ = drive_.T_world_sensor(drive_.sweep(scan).mid_ns).inverse();
    }
    add_firing(packet, firing);
  }
}

void KittiFolderWriter::add_firing(const SimulatedPacket& packet, int firing) {
  constexpr double kStep_s = 1e-4;
  const std::int64_t time_ns = packet.time_ns + firing * hdl64::kFiringPeriod_ns;
  const double turns = drive_.revolutions(time_ns);
  const double later = drive_.revolutions(time_ns + std::llround(kStep_s * 1e9));
  hdl64::FiringReturns returns;
  decoder_.decode(hdl64::PacketView(packet.bytes), firing,
                  {kTurn_rad * (turns - std::floor(turns)), kTurn_rad * (later - turns) / kStep_s}, returns);
  // Over a firing the vehicle moves by a millimetre at most.
  const Eigen::Isometry3d T_mid_sensor =
      T_mid_world_ * drive_.T_world_sensor(time_ns + hdl64::kFiringPeriod_ns / 2);
  for (std::size_t i = 0; i < static_cast<std::size_t>(returns.size); ++i) {
    Eigen::Vector3f p(returns.x_m[i], returns.y_m[i], returns.z_m[i]);
    if (is_compensated_) p = (T_mid_sensor * p.cast<double>()).cast<float>();
    const auto laser = std::size_t{returns.laser[i]};
    const std::size_t block = 2 * static_cast<std::size_t>(firing) + laser / hdl64::kLasersPerBlock;
    const double turn_rad = std::atan2(double{p.y()}, double{p.x()});
    rings_[returns.ring[i]].push_back(
        {p.x(), p.y(), p.z(), static_cast<float>(returns.intensity[i]) / 255.0F,
         packet.labels[block * hdl64::kLasersPerBlock + laser % hdl64::kLasersPerBlock],
         static_cast<float>(turn_rad < 0.0 ? turn_rad + kTurn_rad : turn_rad)});
  }
}

void KittiFolderWriter::write_scan() {
  std::vector<float> points;
  std::vector<std::uint32_t> labels;
  for (auto ring = rings_.rbegin(); ring != rings_.rend(); ++ring) {
    std::ranges::stable_sort(*ring, {}, &Point::turn_rad);
    for (const Point& p : *ring) {
      points.insert(points.end(), {p.x_m, p.y_m, p.z_m, p.intensity});
      labels.push_back(p.label);
    }
    ring->clear();
  }
  const std::string name = format("%06llu", static_cast<unsigned long long>(scan_));
  output::write_file(folder_ / "velodyne" / (name + ".bin"), bytes_of(points));
  output::write_file(folder_ / "labels" / (name + ".label"), bytes_of(labels));
}

void KittiFolderWriter::finish(std::uint64_t num_scans) {
  if (num_scans > scan_) write_scan();
  std::string times, poses;
  const Eigen::Isometry3d T_camera_sensor = evaluation::T_camera_sensor_axes();
  const SweepTimes first = drive_.sweep(0);
  const Eigen::Isometry3d T_first_world = drive_.T_world_sensor(first.mid_ns).inverse();
  for (std::uint64_t i = 0; i < num_scans; ++i) {
    const std::int64_t mid_ns = drive_.sweep(i).mid_ns;
    times += format("%.9e\n", static_cast<double>(mid_ns - first.mid_ns) * 1e-9);
    poses += output::kitti_line(output::to_row(T_camera_sensor * T_first_world *
                                               drive_.T_world_sensor(mid_ns) * T_camera_sensor.inverse()));
  }
  std::string calibration;
  for (int camera = 0; camera < 4; ++camera)
    calibration +=
        format("P%d: ", camera) + output::kitti_line(output::to_row(Eigen::Isometry3d::Identity()));
  calibration += "Tr: " + output::kitti_line(output::to_row(T_camera_sensor));
  output::write_file(folder_ / "times.txt", times);
  output::write_file(folder_ / "poses.txt", poses);
  output::write_file(folder_ / "calib.txt", calibration);
}

}  // namespace pago::simulator
