// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/laser_offsets.hpp"

#include <algorithm>

#include "pago/core/units.hpp"
#include "pago/registration/robust.hpp"

namespace pago::mapping {

using registration::Cell;

namespace {

/// Errors drift with temperature: what was learned so many sweeps ago fades.
constexpr double kMemory_sweeps = 600.0;
constexpr float kKernel_m = 0.06F;

}  // namespace

LaserOffsets::LaserOffsets(const LasersConfig& config) : config_(config) {
  const double range_m = config.range_sigma_m, angle_rad = config.angle_sigma_deg * kDegree;
  prior_ = Eigen::Vector3d(range_m, angle_rad, angle_rad).cwiseAbs2().cwiseInverse().asDiagonal();
  reset();
}

void LaserOffsets::reset() noexcept {
  for (Ring& ring : rings_) ring = {Eigen::Vector3f::Zero(), prior_};
}

// Recursive least squares: the residuals of this sweep, weighed by all that was learned before.
void LaserOffsets::learn(registration::CellMap& map,
                         const registration::PointCloud& points,
                         std::span<const std::uint8_t> rings,
                         const Eigen::Isometry3d& T_map_sensor,
                         const MotionInSweep& motion) noexcept {
  if (!config_.learn) return;
  struct Equations {
    Eigen::Matrix3d H = Eigen::Matrix3d::Zero();
    Eigen::Vector3d b = Eigen::Vector3d::Zero();
  };
  std::array<Equations, kNumRings> equations{};
  const Deskew to_reference(motion);
  const Eigen::Matrix3d R = T_map_sensor.linear();
  const Eigen::Matrix3f R_sensor_map = R.transpose().cast<float>();
  for (std::size_t i = 0; i < std::min(points.size, rings.size()); ++i) {
    const Eigen::Vector3f p = to_reference(points.point(i), points.before_s[i]);
    Eigen::Vector3f offset;
    const Cell* plane =
        map.find_shape(R * p.cast<double>() + T_map_sensor.translation(), points.tag[i], offset);
    if (plane == nullptr) continue;
    const float residual = plane->axis.dot(offset);
    const float weight =
        registration::geman_mcclure(residual, kKernel_m) /
        (static_cast<float>(config_.point_sigma_m * config_.point_sigma_m) + plane->thickness_m2);
    const Eigen::Vector3f n = R_sensor_map * plane->axis;
    const float level = std::max(1e-3F, std::hypot(p.x(), p.y()));
    const Eigen::Vector3d a(n.dot(p.normalized()),
                            n.z() * level - p.z() / level * (n.x() * p.x() + n.y() * p.y()),
                            n.y() * p.x() - n.x() * p.y());
    Equations& of_ring = equations[rings[i] % kNumRings];
    of_ring.H.noalias() += static_cast<double>(weight) * a * a.transpose();
    of_ring.b.noalias() += static_cast<double>(weight * residual) * a;
  }
  for (std::size_t r = 0; r < kNumRings; ++r) {
    Ring& ring = rings_[r];
    ring.information += (prior_ - ring.information) / kMemory_sweeps + equations[r].H;
    ring.offset -= (ring.information.inverse() * equations[r].b).cast<float>();
  }
}

}  // namespace pago::mapping
