// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "pago/config/config.hpp"
#include "pago/core/estimate.hpp"
#include "pago/ground/mount_report.hpp"

namespace pago {

/// One rotation of an HDL-64E, in the frame `sensor` (x forward, y left, z up). The arrays belong to the
/// caller and are read during the call alone.
struct Scan {
  /// In any order. Points that are not finite, or 0, 0, 0, are no returns; they may stay in.
  std::span<const Eigen::Vector3f> points_m;

  /// When each point was measured, in seconds after stamp_ns; within -2 to 2. Empty: the points are in the
  /// frame of one instant already (compensated, as in KITTI's odometry benchmark).
  std::span<const float> times_s = {};

  /// Which laser measured each point, by elevation: 0 the lowest, 63 the highest. Empty: found out (see
  /// ScanOrganizer), exactly if the scan goes ring by ring as KITTI's do; else by elevation, where rings mix
  /// and overfull ones leave points out (KITTI's 16 scans, shuffled: 0.8 %; 3 cm off after 11.7 m).
  std::span<const std::uint8_t> rings = {};

  /// Start of the rotation, ns; of any clock, e.g. since the Unix epoch.
  std::int64_t stamp_ns = 0;

  /// How long the rotation took, 0 to 1 s. Between 40 and 250 ms it tells how many firings there were.
  std::int64_t duration_ns = 100'000'000;
};

/// Odometry for those who have scans and no use for threads: the stages of Pipeline (ground, features,
/// odometry), one after the other on the caller's thread. The poses are the same, to the last bit.
///
///   pago::Odometry odometry;
///   const pago::Estimate now = odometry.process({.points_m = points, .stamp_ns = stamp_ns});
///   if (now.has_pose) use(now.T_odom_sensor_refined, now.health);
///
/// Poses hold for the instant `odometry.pose_instant` says; those of compensated scans for the middle,
/// stamp_ns + duration_ns / 2. The first scan's is the identity.
///
/// A scan is refused, and nothing else changes, if
///   - there are more points than max_points();
///   - times_s or rings are not empty and not as many as the points, a time is beyond +-2 s or not a number,
///     or a ring is above 63;
///   - duration_ns is not within 0 to 1 s, or stamp_ns is beyond 2^62.
/// Then the estimate has no pose, the health is LOST, its reason kRefusedScan, and refusal() has the words. A
/// scan that is not later than the last one, or much later, is no such case: its reason is kTimeGap.
///
/// Of the configuration it uses `mount`, `vehicle`, `ground`, `features`, `odometry` and
/// `assembly.max_returns`. Objects are independent of each other. [set-up] constructor; [one thread at a
/// time] the rest. process() is real-time safe: no allocation, lock, file or log; 25 ms of CPU time for one
/// of KITTI's scans of 120,000 points (measured on a busy machine), six times that where a first motion has
/// to be found (second scan, time gap). Not with the paper presets (config/preset.hpp), which allocate.
class Odometry {
 public:
  /// Allocates all that will be needed. Throws Error: a setting that cannot be used, a ground method that
  /// needs labels.
  explicit Odometry(const Config& config = {});
  ~Odometry();
  Odometry(Odometry&&) noexcept;
  Odometry& operator=(Odometry&&) noexcept;

  Estimate process(const Scan& scan) noexcept;

  /// The ground mask of the last scan, kGround or kNonGround for each of its points; empty if it was refused.
  /// Valid until the next process().
  std::span<const std::uint8_t> ground() const noexcept;

  /// Whether the ground was where the mount says in the first scans; ground::to_text() puts it in words.
  const ground::MountReport& mount_report() const noexcept;

  /// Why the last scan was refused; empty if it was not.
  std::string_view refusal() const noexcept;

  std::size_t max_points() const noexcept;
  /// Scans so far whose rings had to be found out and are not certain.
  std::uint64_t scans_with_guessed_rings() const noexcept;
  /// Points so far that were left out, because their ring had more than a rotation has firings.
  std::uint64_t points_left_out() const noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pago
