// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "kitti_folder.hpp"

#include <ranges>
#include <string>

#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/trajectory.hpp"
#include "pago/output/text_file.hpp"
#include "pago/output/trajectory_writer.hpp"

namespace pago::simulator {
namespace {

template <typename T>
std::string_view bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace

KittiFolder::KittiFolder(const std::filesystem::path& folder) : folder_(folder) {
  output::make_folders(folder / "velodyne");
  output::make_folders(folder / "labels");
  // Scans of another drive, were it longer, would stay and be taken for this one's.
  if (!std::filesystem::is_empty(folder / "velodyne"))
    throw Error((folder / "velodyne").string(), "holds scans already",
                "choose another folder with --kitti, or remove this one");
}

void KittiFolder::write_scan(std::uint64_t scan, const LabelledRings& rings) const {
  std::vector<float> points;
  std::vector<std::uint32_t> labels;
  for (const std::vector<LabelledPoint>& ring : rings | std::views::reverse) {
    for (const LabelledPoint& p : ring) {
      points.insert(points.end(), {p.x_m, p.y_m, p.z_m, p.intensity});
      labels.push_back(p.label);
    }
  }
  const std::string name = format("%06llu", static_cast<unsigned long long>(scan));
  output::write_file(folder_ / "velodyne" / (name + ".bin"), bytes_of(points));
  output::write_file(folder_ / "labels" / (name + ".label"), bytes_of(labels));
}

void KittiFolder::finish(const Simulator& drive, std::uint64_t num_scans) const {
  std::string times, poses;
  const Eigen::Isometry3d T_camera_sensor = evaluation::T_camera_sensor_axes();
  const SweepTimes first = drive.sweep(0);
  const Eigen::Isometry3d T_first_world = drive.T_world_sensor(first.mid_ns).inverse();
  for (std::uint64_t i = 0; i < num_scans; ++i) {
    const std::int64_t mid_ns = drive.sweep(i).mid_ns;
    times += format("%.9e\n", static_cast<double>(mid_ns - first.mid_ns) * 1e-9);
    poses += output::kitti_line(output::to_row(T_camera_sensor * T_first_world *
                                               drive.T_world_sensor(mid_ns) * T_camera_sensor.inverse()));
  }
  std::string calibration;
  for (int camera = 0; camera < 4; ++camera)
    calibration += format("P%d: ", camera) + output::kitti_line(output::kIdentityRow);
  calibration += "Tr: " + output::kitti_line(output::to_row(T_camera_sensor));
  output::write_file(folder_ / "times.txt", times);
  output::write_file(folder_ / "poses.txt", poses);
  output::write_file(folder_ / "calib.txt", calibration);
}

}  // namespace pago::simulator
