// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "mount_check.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/units.hpp"
#include "points.hpp"

namespace pago::ground {
namespace {

constexpr RansacRule kAnyPlane{.inlier_distance_m = 0.12, .max_iterations = 200, .confidence = 0.999};
constexpr double kFarthestUp_deg = 30.0;  // a plane tilted more is no ground as the mount has it

// Shares of the near returns. Ground holds half of them and more on a road, a quarter among parked cars.
constexpr double kMinGround = 0.15;
// The largest plane of all is the ground even if it lies elsewhere when the one below holds less than this of
// it.
constexpr double kMaxRival = 0.4;
constexpr double kMinElsewhere = 0.3;
// No ground is farther from the sensor than so many times the mount's height: a house front may be.
constexpr double kMostHeights = 2.5;
// An HDL-64E that stands as it should has no more than a tenth of its returns above itself.
constexpr double kMostlyAbove = 0.5;
// A sensor mounted to look less down than this (its z axis, levelled) sees the ground from afar only, and
// most of its returns may be above it.
constexpr double kLooksDown = 0.5;

/// How many points a plane holds.
double share_on(const Points& points, const PlaneFit& plane) noexcept {
  const auto on = static_cast<double>(count_inside(points, plane.around(kAnyPlane.inlier_distance_m)));
  return on / static_cast<double>(points.size());
}

}  // namespace

MountCheck::MountCheck(const MountCheckConfig& config, const Mount& mount)
    : config_(config),
      expected_(mount),
      R_level_sensor_(mount.R_level_sensor()),
      x_m_(kMaxPoints),
      y_m_(kMaxPoints),
      z_m_(kMaxPoints),
      glimpses_(static_cast<std::size_t>(config.sweeps)),
      numbers_(static_cast<std::size_t>(config.sweeps)) {}

void MountCheck::look_at(const Sweep& sweep) noexcept {
  if (!is_pending() || !config_.enabled || !sweep.header.is_posed() || sweep.header.has(kIncomplete)) return;
  Glimpse& glimpse = glimpses_[num_glimpses_];
  glimpse = {};
  const std::size_t size = gather(sweep, glimpse);
  constexpr std::size_t kTooFew = 200;
  if (size >= kTooFew) find_planes({x_m_.first(size), y_m_.first(size), z_m_.first(size)}, glimpse);
  ++num_glimpses_;
  report_.num_sweeps = static_cast<std::uint32_t>(num_glimpses_);
  report_.so_far = judge();
  if (num_glimpses_ == glimpses_.size()) report_.finding = report_.so_far;
}

/// Every so many returns, levelled as the mount says. Returns arrive laser by laser, in blocks of 32: an odd
/// stride comes to all of them.
std::size_t MountCheck::gather(const Sweep& sweep, Glimpse& glimpse) noexcept {
  const std::uint32_t stride = (sweep.size / static_cast<std::uint32_t>(kMaxPoints) + 1) | 1U;
  const Eigen::Matrix3f R = R_level_sensor_.cast<float>();
  const auto far_m = static_cast<float>(config_.max_range_m);
  constexpr float kNear_m = 2.0F;  // the vehicle
  std::size_t size = 0, above = 0, all = 0;
  for (std::uint32_t i = 0; i < sweep.size; i += stride) {
    const Eigen::Vector3f p = R * Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    if (!is_return(p.x(), p.y(), p.z())) continue;
    ++all;
    above += p.z() > 0.0F ? 1U : 0U;
    const float range_m = p.norm();
    if (range_m < kNear_m || range_m > far_m) continue;
    x_m_[size] = p.x();
    y_m_[size] = p.y();
    z_m_[size++] = p.z();
  }
  glimpse.share_above = all == 0 ? 0.0 : static_cast<double>(above) / static_cast<double>(all);
  return size;
}

void MountCheck::find_planes(const Points& points, Glimpse& glimpse) const noexcept {
  RansacRule below = kAnyPlane;
  below.min_uprightness = std::cos(kFarthestUp_deg * kDegree);
  constexpr std::uint64_t kSeed = 1;
  const PlaneFit ground = ransac_plane(points, below, kSeed);
  if (ground.is_valid && ground.normal.dot(ground.mean) < 0.0) {
    glimpse.up_below = ground.normal;
    glimpse.height_below_m = -ground.normal.dot(ground.mean);
    glimpse.share_below = share_on(points, ground);
  }
  const PlaneFit any = ransac_plane(points, kAnyPlane, kSeed);
  if (!any.is_valid) return;
  const double offset_m = any.normal.dot(any.mean);
  glimpse.up_anywhere = offset_m < 0.0 ? any.normal : Eigen::Vector3d(-any.normal);
  glimpse.height_anywhere_m = std::abs(offset_m);
  glimpse.share_anywhere = share_on(points, any);
}

template <typename Number>
double MountCheck::median(const Number& number) noexcept {
  for (std::size_t i = 0; i < num_glimpses_; ++i) numbers_[i] = number(glimpses_[i]);
  const auto middle = numbers_.begin() + static_cast<std::ptrdiff_t>(num_glimpses_ / 2);
  std::nth_element(numbers_.begin(), middle, numbers_.begin() + static_cast<std::ptrdiff_t>(num_glimpses_));
  return *middle;
}

template <typename Vector>
Eigen::Vector3d MountCheck::median_direction(const Vector& vector) noexcept {
  Eigen::Vector3d result;
  for (Eigen::Index k = 0; k < 3; ++k) result[k] = median([&](const Glimpse& g) { return (g.*vector)[k]; });
  return result.stableNormalized();
}

/// Of the sweeps so far.
MountFinding MountCheck::judge() noexcept {
  const double share_below = median([](const Glimpse& g) { return g.share_below; });
  const double share_anywhere = median([](const Glimpse& g) { return g.share_anywhere; });
  const double height_below_m = median([](const Glimpse& g) { return g.height_below_m; });
  const double height_anywhere_m = median([](const Glimpse& g) { return g.height_anywhere_m; });
  report_.share_above = median([](const Glimpse& g) { return g.share_above; });
  report_.has_estimate = false;
  const double farthest_m = kMostHeights * expected_.height_m;
  const bool is_anywhere = share_anywhere >= kMinElsewhere && height_anywhere_m <= farthest_m;
  // Seen by a sensor on its side, a house front lies below it, and the ground beside it is nearer.
  const bool is_front = height_below_m > farthest_m && is_anywhere && share_anywhere > share_below;
  const bool is_below = share_below >= kMinGround && share_below >= kMaxRival * share_anywhere && !is_front;
  if (is_below) {
    const Eigen::Vector3d up = median_direction(&Glimpse::up_below);
    set_estimate(up, height_below_m, share_below);
    return judge_below(up);
  }
  const Eigen::Vector3d up = is_anywhere ? median_direction(&Glimpse::up_anywhere) : Eigen::Vector3d::Zero();
  const bool is_above = up.z() < -0.7;
  const bool looks_down = (R_level_sensor_ * Eigen::Vector3d::UnitZ()).z() > kLooksDown;
  const bool is_inverted = is_above || (looks_down && report_.share_above >= kMostlyAbove);
  if (is_above || (is_anywhere && !is_inverted)) set_estimate(up, height_anywhere_m, share_anywhere);
  if (is_inverted) return MountFinding::kUpsideDown;
  if (is_anywhere) return MountFinding::kRotated;
  return looks_down ? MountFinding::kNoGround : MountFinding::kUnseen;
}

/// Of a ground below the sensor, the estimate's.
MountFinding MountCheck::judge_below(const Eigen::Vector3d& up) const noexcept {
  const double tilt_deg = std::acos(std::clamp(up.z(), -1.0, 1.0)) / kDegree;
  if (tilt_deg > config_.max_tilt_error_deg) return MountFinding::kTilted;
  const bool is_high = std::abs(report_.height_m - expected_.height_m) > config_.max_height_error_m;
  return is_high ? MountFinding::kWrongHeight : MountFinding::kAgrees;
}

/// `up` in levelled coordinates. R_level_sensor's last row is the vehicle's up as the sensor sees it.
void MountCheck::set_estimate(const Eigen::Vector3d& up, double height_m, double share) noexcept {
  const Eigen::Vector3d up_sensor = R_level_sensor_.transpose() * up;
  report_.has_estimate = true;
  report_.height_m = height_m;
  report_.roll_rad = std::atan2(up_sensor.y(), up_sensor.z());
  report_.pitch_rad = std::asin(std::clamp(-up_sensor.x(), -1.0, 1.0));
  report_.ground_share = share;
}

}  // namespace pago::ground
