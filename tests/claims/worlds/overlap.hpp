// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "drivers/simulator/scan_collector.hpp"
#include "drivers/simulator/surface.hpp"
#include "pago/config/config.hpp"
#include "pago/simulator/simulator.hpp"

/// Simulated sweeps, decoded with the unit's file and de-skewed by the truth, laid over each other.
namespace pago::claims {

struct Cloud {
  std::vector<Eigen::Vector3d> standing, moving;   ///< in the world
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< where the sensor was in its middle
};

/// Some sweeps of a drive, in the order of `scans`; nothing else of it is rendered.
inline std::vector<Cloud> clouds(simulator::Simulator& drive, const std::vector<std::uint64_t>& scans) {
  using simulator::Label;
  std::vector<Cloud> result;
  std::uint64_t wanted = 0;
  const auto use = [&](std::uint64_t scan, const simulator::LabelledRings& rings) {
    if (scan != wanted) return;  // a few firings of the one before
    const Eigen::Isometry3d T = drive.T_world_sensor(drive.sweep(scan).mid_ns);
    Cloud cloud;
    cloud.from = T.translation();
    for (const auto& ring : rings) {
      for (const simulator::LabelledPoint& p : ring) {
        const auto label = static_cast<Label>(p.label);
        if (label == Label::kOutlier) continue;
        const bool moves =
            label == Label::kMovingCar || label == Label::kMovingTruck || label == Label::kMovingPerson;
        (moves ? cloud.moving : cloud.standing)
            .push_back(T * Eigen::Vector3f(p.x_m, p.y_m, p.z_m).cast<double>());
      }
    }
    result.push_back(std::move(cloud));
  };
  simulator::SimulatedPacket packet;
  for (const std::uint64_t scan : scans) {
    wanted = scan;
    simulator::ScanCollector collector(drive, {}, true, use);
    drive.skip_to(drive.sweep(scan).start_ns);
    const std::size_t before = result.size();
    while (result.size() == before && drive.next(packet)) collector.add(packet);
  }
  return result;
}

/// Points in cells of kReach_m.
class Neighbours {
 public:
  static constexpr double kReach_m = 0.5;

  explicit Neighbours(const std::vector<Eigen::Vector3d>& points) {
    for (const Eigen::Vector3d& p : points) cells_[key(cell(p))].push_back(p);
  }

  std::vector<Eigen::Vector3d> around(const Eigen::Vector3d& p) const {
    std::vector<Eigen::Vector3d> result;
    const Eigen::Vector3i here = cell(p);
    for (int i = 0; i < 27; ++i) {
      const auto found = cells_.find(key(here + Eigen::Vector3i(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1)));
      if (found == cells_.end()) continue;
      for (const Eigen::Vector3d& q : found->second)
        if ((q - p).norm() < kReach_m) result.push_back(q);
    }
    return result;
  }

 private:
  static Eigen::Vector3i cell(const Eigen::Vector3d& p) {
    return (p / kReach_m).array().floor().matrix().cast<int>();
  }
  static std::uint64_t key(const Eigen::Vector3i& c) {
    const auto part = [](int i) { return static_cast<std::uint64_t>(i + (1 << 20)) & 0x1FFFFFU; };
    return part(c.x()) << 42U | part(c.y()) << 21U | part(c.z());
  }
  std::unordered_map<std::uint64_t, std::vector<Eigen::Vector3d>> cells_;
};

inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Distance of a point from the plane through eight or more neighbours that lie flat; NaN without any.
inline double from_surface_m(const std::vector<Eigen::Vector3d>& neighbours, const Eigen::Vector3d& p) {
  if (neighbours.size() < 8) return std::numeric_limits<double>::quiet_NaN();
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& q : neighbours) mean += q / static_cast<double>(neighbours.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& q : neighbours) spread += (q - mean) * (q - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  if (axes.eigenvalues()[0] > 0.1 * axes.eigenvalues()[1]) return std::numeric_limits<double>::quiet_NaN();
  return std::abs(axes.eigenvectors().col(0).dot(p - mean));
}

/// Every `kEvery`th standing point of `b` against the surfaces of `a`.
inline double surfaces_apart_m(const Cloud& a, const Cloud& b) {
  constexpr std::size_t kEvery = 7;
  const Neighbours neighbours(a.standing);
  std::vector<double> distances;
  for (std::size_t i = 0; i < b.standing.size(); i += kEvery) {
    const double distance_m = from_surface_m(neighbours.around(b.standing[i]), b.standing[i]);
    if (!std::isnan(distance_m)) distances.push_back(distance_m);
  }
  return distances.size() < 500 ? std::numeric_limits<double>::quiet_NaN() : median(std::move(distances));
}

/// The part of `b` that has no point of `a` within a fifth of a metre, where the beams of both are dense.
inline double part_alone(const std::vector<Eigen::Vector3d>& a,
                         const std::vector<Eigen::Vector3d>& b,
                         const Eigen::Vector3d& from) {
  constexpr double kNear_m = 0.2, kDense_m = 15.0;
  const Neighbours neighbours(a);
  double alone = 0.0, all = 0.0;
  for (const Eigen::Vector3d& p : b) {
    if ((p - from).norm() > kDense_m) continue;
    const auto near = neighbours.around(p);
    all += 1.0;
    alone += std::ranges::none_of(near, [&](const Eigen::Vector3d& q) { return (q - p).norm() < kNear_m; })
                 ? 1.0
                 : 0.0;
  }
  return all < 200.0 ? std::numeric_limits<double>::quiet_NaN() : alone / all;
}

}  // namespace pago::claims
