// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <vector>

#include "pago/mapping/joint_registration.hpp"

namespace pago::mapping {

/// Finds the motion that the sensor is switched on in. Nothing predicts it, both first sweeps are distorted
/// by it, and one pair of sweeps can fit best for a wrong one: the pattern of scan lines on the ground and
/// the traffic that drives along fit zero motion (seen on motorways: spec/odometry-prototype.md section 6).
/// So several motions are carried on, each with a small map of its own, until one explains the sweeps best.
///
/// [set-up] constructor: about 20 MB and 2 MB per hypothesis; [estimate thread] the rest: real-time safe,
/// deterministic; add() takes up to 60 ms the first time, then up to 30 ms.
class StartSearch {
 public:
  explicit StartSearch(const MappingConfig& config);

  /// The points of a sweep. All the `dense` ones make the maps of the search: of few sweeps a cell has few
  /// points.
  struct Points {
    const registration::PointCloud &dense, &map, &key;
  };

  /// The first sweep.
  void begin(const Points& points, bool is_compensated) noexcept;

  /// The next one, `period_s` (> 0) after the last by their reference instants.
  void add(const Points& points, double period_s) noexcept;

  /// One hypothesis is left, or none is going to be told from the others.
  bool is_decided() const noexcept;

  /// The best one so far; after begin() alone standing still.
  const Eigen::Isometry3d& T_start_last() const noexcept;  ///< of the last sweep, from the first one's frame
  const Vector6d& twist() const noexcept;                  ///< per second, over the last period
  const JointResult& result() const noexcept;              ///< of the last sweep
  int num_sweeps() const noexcept { return num_sweeps_; }

  /// Registers the first sweep against all that came after it: so far it was only registered against.
  void settle() noexcept;
  /// The first sweep's pose in the frame of the others (after settle() no longer quite the identity), and the
  /// velocity in it.
  const Eigen::Isometry3d& T_start_first() const noexcept { return paths_[0].T_start_sweep[0]; }
  const Vector6d& first_twist() const noexcept { return paths_[0].twist[0]; }

  /// Puts all sweeps into `map`, as the best hypothesis places them; `T_map_start` is the first one's pose.
  void hand_over(const Eigen::Isometry3d& T_map_start, registration::CellMap& map) const noexcept;

 private:
  static constexpr int kLeastSweeps = 5, kMostSweeps = 8;
  static constexpr std::size_t kMostHypotheses = 4;

  struct StoredSweep {
    StoredSweep();
    registration::PointCloud dense, map, key;
    double period_s = 0.0;  // since the sweep before
  };
  struct Path {
    std::array<Eigen::Isometry3d, kMostSweeps> T_start_sweep;
    std::array<Vector6d, kMostSweeps> twist;
    JointResult last;
    double score = 0.0;  // summed over the sweeps after the first

    double mean_score(int num_sweeps) const noexcept { return score / (num_sweeps - 1); }
  };

  std::size_t last() const noexcept { return static_cast<std::size_t>(num_sweeps_ - 1); }
  void store(const Points& points, double period_s) noexcept;
  void sow() noexcept;
  void keep(const JointResult& result, double period_s) noexcept;
  void advance(Path& path, registration::CellMap& map) noexcept;
  void refine(Path& path, registration::CellMap& map) noexcept;
  void adopt(Path& path, const JointResult& result) noexcept;
  JointResult align(registration::CellMap& map,
                    const registration::PointCloud& points,
                    const MotionGuess& guess) noexcept;
  Vector6d first_twist_of(const Path& path) const noexcept;
  MotionInSweep within(const Path& path, std::size_t sweep) const noexcept;
  void insert(const Path& path, std::size_t sweep, registration::CellMap& map) const noexcept;
  void rank() noexcept;
  bool agree(const Path& a, const Path& b) const noexcept;

  MappingConfig config_;
  std::vector<Vector6d> seeds_;  // per second
  JointRegistration registration_;
  std::vector<StoredSweep> sweeps_;
  registration::CellMap scratch_;
  std::vector<registration::CellMap> maps_;  // maps_[map_of_[h]] belongs to paths_[h]
  std::array<Path, kMostHypotheses> paths_;  // best first
  std::array<std::size_t, kMostHypotheses> map_of_{};
  std::size_t num_paths_ = 0;
  int num_sweeps_ = 0;
  bool is_compensated_ = false;
};

}  // namespace pago::mapping
