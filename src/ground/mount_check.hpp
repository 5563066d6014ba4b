// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/config/ground/mount_check.hpp"
#include "pago/core/sweep.hpp"
#include "pago/ground/mount_report.hpp"
#include "ransac_plane.hpp"

namespace pago::ground {

/// Looks for the ground in the first sweeps, below the sensor as the mount has it and anywhere else, and
/// compares. In each sweep a few thousand returns near by are looked at; the verdict is that of the middle
/// sweep (medians), given so far after each sweep and for good after the last. [front thread] everything but
/// the constructor; real-time safe.
class MountCheck {
 public:
  /// [set-up] Allocates.
  MountCheck(const MountCheckConfig& config, const Mount& mount);

  /// Whole sweeps; others are passed over. Does nothing once there is a verdict.
  void look_at(const Sweep& sweep) noexcept;

  /// For the report: the estimated height that the method works with.
  void note_height(double height_m) noexcept { report_.set_height_m = height_m; }

  bool is_pending() const noexcept { return report_.finding == MountFinding::kPending; }
  const MountReport& report() const noexcept { return report_; }

 private:
  static constexpr std::size_t kMaxPoints = 4096;
  /// What one sweep shows. Planes are given by the direction from them to the sensor, and its length.
  struct Glimpse {
    Eigen::Vector3d up_below = Eigen::Vector3d::Zero(), up_anywhere = Eigen::Vector3d::Zero();
    double height_below_m = 0.0, height_anywhere_m = 0.0;
    double share_below = 0.0, share_anywhere = 0.0;  // of the points looked at
    double share_above = 0.0;
  };

  std::size_t gather(const Sweep& sweep, Glimpse& glimpse) noexcept;
  void find_planes(const Points& points, Glimpse& glimpse) const noexcept;
  MountFinding judge() noexcept;
  MountFinding judge_below(const Eigen::Vector3d& up) const noexcept;
  void set_estimate(const Eigen::Vector3d& up, double height_m, double share) noexcept;
  template <typename Number>
  double median(const Number& number) noexcept;
  template <typename Vector>
  Eigen::Vector3d median_direction(const Vector& vector) noexcept;

  MountCheckConfig config_;
  Mount expected_;
  Eigen::Matrix3d R_level_sensor_;
  AlignedArray<float> x_m_, y_m_, z_m_;
  std::vector<Glimpse> glimpses_;
  std::vector<double> numbers_;  // for medians
  std::size_t num_glimpses_ = 0;
  MountReport report_;
};

}  // namespace pago::ground
