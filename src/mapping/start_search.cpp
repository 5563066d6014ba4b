// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/start_search.hpp"

#include <algorithm>
#include <cmath>

#include "local_map.hpp"
#include "pago/core/se3.hpp"
#include "pago/core/sweep.hpp"
#include "pago/core/symmetric6.hpp"
#include "pago/core/units.hpp"

namespace pago::mapping {

using registration::CellMap;
using registration::PointCloud;

namespace {

/// A few sweeps' cells.
constexpr std::uint32_t kCells = 40'000;
/// Seeds are tried on a part of the points: there are many seeds, and they need only fall into a hollow.
constexpr std::size_t kSeedStride = 3;
constexpr std::size_t kSeedMapStride = 2;
constexpr int kSeedIterations = 5;
constexpr double kNoSpeed = 1e9, kNoScore = -1e9;

/// Motions that a road vehicle may be found in. Fast ones turn little.
std::vector<Vector6d> seeds_of(const StartConfig& c) {
  std::vector<Vector6d> seeds;
  const auto sow = [&seeds](double speed_m_s, double turn_rad_s) {
    Vector6d twist = Vector6d::Zero();
    twist[0] = speed_m_s, twist[5] = turn_rad_s;
    seeds.push_back(twist);
  };
  const double turn_rad_s = c.turn_rate_deg_s * kDegree;
  for (double speed_m_s = 0.0; speed_m_s <= c.max_speed_m_s; speed_m_s += c.speed_step_m_s) {
    sow(speed_m_s, 0.0);
    if (speed_m_s > 0.5 * c.max_speed_m_s) continue;
    sow(speed_m_s, turn_rad_s);
    sow(speed_m_s, -turn_rad_s);
  }
  sow(-c.speed_step_m_s, 0.0);
  return seeds;
}

/// All points of the few sweeps count.
registration::CellMapOptions cells_of(const MappingConfig& config) noexcept {
  registration::CellMapOptions options = options_of(config.cells);
  options.max_points = 10'000;
  return options;
}

/// How far off a position may be, in the direction that is known least; within reason.
double vagueness_m(const JointResult& result) noexcept {
  const Matrix6d information = result.information + Matrix6d::Identity();
  return std::clamp(std::sqrt(inverse_of(information).diagonal().head<3>().maxCoeff()), 0.001, 1.0);
}

/// How well what is matched fits; less, how much is matched: a map that moves past the sensor fills, that of
/// one that stands does not; and how sharply: a wrong motion smears what faces it. Where nothing else tells
/// motions apart, the sensor stands.
double score_of(const JointResult& result, const Vector6d& twist) noexcept {
  constexpr double kCoverage = 0.1, kPerSharpness = 0.05, kPerSpeed_s_m = 0.0002;
  const double offered = std::max(1U, result.offered);
  return result.score * offered / (result.matches + kCoverage * offered) -
         kPerSharpness * std::log(vagueness_m(result)) - kPerSpeed_s_m * twist.head<3>().norm();
}

}  // namespace

StartSearch::StoredSweep::StoredSweep() : dense(kMaxDensePoints), map(kMaxMapPoints), key(kMaxKeyPoints) {}

StartSearch::StartSearch(const MappingConfig& config)
    : config_(config),
      seeds_(seeds_of(config.start)),
      registration_(config, kMaxKeyPoints),
      sweeps_(kMostSweeps),
      scratch_(cells_of(config), kCells) {
  for (std::size_t h = 0; h < kMostHypotheses; ++h) maps_.emplace_back(cells_of(config), kCells);
}

void StartSearch::begin(const Points& points, bool is_compensated) noexcept {
  is_compensated_ = is_compensated;
  num_sweeps_ = 0;
  store(points, 0.0);
  num_paths_ = 1;
  paths_[0] = {};
  paths_[0].T_start_sweep[0].setIdentity();
  paths_[0].twist[0].setZero();
}

void StartSearch::add(const Points& points, double period_s) noexcept {
  store(points, period_s);
  if (num_sweeps_ == 2) sow();
  for (std::size_t h = 0; h < num_paths_; ++h) advance(paths_[h], maps_[map_of_[h]]);
  rank();
  refine(paths_[0], maps_[map_of_[0]]);
  for (std::size_t h = 0; h < num_paths_; ++h) insert(paths_[h], last(), maps_[map_of_[h]]);
}

void StartSearch::store(const Points& points, double period_s) noexcept {
  StoredSweep& sweep = sweeps_[static_cast<std::size_t>(num_sweeps_++)];
  copy(points.dense, sweep.dense);
  copy(points.map, sweep.map);
  copy(points.key, sweep.key);
  sweep.period_s = period_s;
}

bool StartSearch::is_decided() const noexcept {
  return num_sweeps_ >= kLeastSweeps && (num_paths_ == 1 || num_sweeps_ == kMostSweeps);
}

const Eigen::Isometry3d& StartSearch::T_start_last() const noexcept {
  return paths_[0].T_start_sweep[last()];
}
const Vector6d& StartSearch::twist() const noexcept {
  return paths_[0].twist[last()];
}
const JointResult& StartSearch::result() const noexcept {
  return paths_[0].last;
}

// The first sweep is distorted by the motion that is sought, so it is de-skewed by each speed tried. Turns
// are tried against the same map: at the rates of vehicles their distortion is below a cell. What is found is
// only a start value.
void StartSearch::sow() noexcept {
  const double period_s = sweeps_[1].period_s;
  num_paths_ = 0;
  MotionGuess guess;
  guess.period_s = is_compensated_ ? 0.0 : period_s;
  double mapped_m_s = kNoSpeed;
  for (const Vector6d& seed : seeds_) {
    if (seed[0] != mapped_m_s) {
      mapped_m_s = seed[0];
      MotionInSweep straight;
      if (!is_compensated_) straight.twist[0] = mapped_m_s;
      scratch_.clear();
      insert_points(sweeps_[0].dense, straight, Eigen::Isometry3d::Identity(), scratch_, kSeedMapStride);
    }
    guess.T_last_this = exp_se3(seed * period_s);
    keep(registration_.align(scratch_, sweeps_[1].key, guess,
                             {config_.gate_m, config_.start.kernel_m, kSeedIterations, kSeedStride, false}),
         period_s);
  }
  for (std::size_t h = 0; h < num_paths_; ++h) {
    map_of_[h] = h;
    maps_[h].clear();
    insert(paths_[h], 0, maps_[h]);
    paths_[h].score = 0.0;  // counted when it is registered with all points
  }
}

// Among the best that differ from each other.
void StartSearch::keep(const JointResult& result, double period_s) noexcept {
  Path path;
  path.last = result;
  path.T_start_sweep[0].setIdentity();
  path.T_start_sweep[1] = result.T_last_this;
  path.twist[0] = path.twist[1] = log_se3(result.T_last_this) / period_s;
  path.score = score_of(result, path.twist[1]);

  std::size_t at = 0;
  while (at < num_paths_ && !agree(paths_[at], path)) ++at;
  if (at == num_paths_ && num_paths_ < kMostHypotheses) paths_[num_paths_++].score = kNoScore;
  at = std::min(at, num_paths_ - 1);  // one like it, the room for another, or the worst
  if (paths_[at].score >= path.score) return;
  paths_[at] = path;
  for (; at > 0 && paths_[at].score > paths_[at - 1].score; --at) std::swap(paths_[at], paths_[at - 1]);
}

void StartSearch::advance(Path& path, CellMap& map) noexcept {
  const double period_s = sweeps_[last()].period_s;
  MotionGuess guess;
  guess.T_map_last = path.T_start_sweep[last() - 1];
  guess.T_last_this = exp_se3(path.twist[last() - 1] * period_s);
  guess.period_s = is_compensated_ ? 0.0 : period_s;
  const JointLimits coarse{config_.gate_m, config_.start.kernel_m, 2, kSeedStride, false};
  guess.T_last_this = registration_.align(map, sweeps_[last()].key, guess, coarse).T_last_this;
  adopt(path, align(map, sweeps_[last()].key, guess));
  path.score += score_of(path.last, path.twist[last()]);
}

// What is reported is worth more points.
void StartSearch::refine(Path& path, CellMap& map) noexcept {
  MotionGuess guess;
  guess.T_map_last = path.T_start_sweep[last() - 1];
  guess.T_last_this = path.last.T_last_this;
  guess.period_s = is_compensated_ ? 0.0 : sweeps_[last()].period_s;
  adopt(path, align(map, sweeps_[last()].map, guess));
}

void StartSearch::adopt(Path& path, const JointResult& result) noexcept {
  path.last = result;
  path.T_start_sweep[last()] = path.T_start_sweep[last() - 1] * result.T_last_this;
  path.twist[last()] = log_se3(result.T_last_this) / sweeps_[last()].period_s;
  path.twist[0] = first_twist_of(path);
}

// Velocities are between the middles of sweeps; the first sweep's own is half a period before the first of
// them.
Vector6d StartSearch::first_twist_of(const Path& path) const noexcept {
  return num_sweeps_ == 2 ? path.twist[1] : path.twist[1] + 0.5 * (path.twist[1] - path.twist[2]);
}

JointResult StartSearch::align(CellMap& map, const PointCloud& points, const MotionGuess& guess) noexcept {
  const std::size_t stride = 1 + points.size / (kMaxKeyPoints + 1);
  return registration_.align(map, points, guess,
                             {config_.gate_m, config_.kernel_min_m, config_.max_iterations, stride, false});
}

MotionInSweep StartSearch::within(const Path& path, std::size_t sweep) const noexcept {
  return {is_compensated_ ? Vector6d::Zero().eval() : path.twist[sweep]};
}

void StartSearch::insert(const Path& path, std::size_t sweep, CellMap& map) const noexcept {
  insert_points(sweeps_[sweep].dense, within(path, sweep), path.T_start_sweep[sweep], map);
}

void StartSearch::settle() noexcept {
  constexpr int kPasses = 2;
  Path& path = paths_[0];
  scratch_.clear();
  for (std::size_t i = 1; i <= last(); ++i) insert(path, i, scratch_);
  for (int pass = 0; pass < kPasses; ++pass) {
    MotionGuess guess;
    guess.T_map_last = path.T_start_sweep[0];
    guess.period_s = is_compensated_ ? 0.0 : sweeps_[1].period_s;
    guess.twist = path.twist[0];
    path.T_start_sweep[0] = guess.T_map_last * align(scratch_, sweeps_[0].map, guess).T_last_this;
    path.twist[1] = log_se3(path.T_start_sweep[0].inverse() * path.T_start_sweep[1]) / sweeps_[1].period_s;
    path.twist[0] = first_twist_of(path);
  }
}

void StartSearch::hand_over(const Eigen::Isometry3d& T_map_start, CellMap& map) const noexcept {
  for (std::size_t i = 0; i <= last(); ++i)
    insert_points(sweeps_[i].map, within(paths_[0], i), T_map_start * paths_[0].T_start_sweep[i], map);
}

// Best first; gives up those that have come to agree with a better one, and those that fall behind: by less
// and less the more sweeps have spoken.
void StartSearch::rank() noexcept {
  for (std::size_t h = 1; h < num_paths_; ++h) {
    for (std::size_t at = h; at > 0 && paths_[at].score > paths_[at - 1].score; --at) {
      std::swap(paths_[at], paths_[at - 1]);
      std::swap(map_of_[at], map_of_[at - 1]);
    }
  }
  constexpr double kMargin = 0.15;
  const double least = paths_[0].mean_score(num_sweeps_) - kMargin / (num_sweeps_ - 1);
  std::size_t kept = 1;
  for (std::size_t h = 1; h < num_paths_; ++h) {
    bool is_needless = paths_[h].mean_score(num_sweeps_) < least;
    for (std::size_t better = 0; better < kept; ++better)
      is_needless = is_needless || agree(paths_[better], paths_[h]);
    if (is_needless) continue;
    if (kept != h) {
      paths_[kept] = paths_[h];
      std::swap(map_of_[kept], map_of_[h]);
    }
    ++kept;
  }
  num_paths_ = kept;
}

bool StartSearch::agree(const Path& a, const Path& b) const noexcept {
  constexpr double kSame_m = 0.05, kSame_rad = 0.005;
  const Vector6d apart = difference(a.last.T_last_this, b.last.T_last_this);
  return apart.head<3>().norm() < kSame_m && apart.tail<3>().norm() < kSame_rad;
}

}  // namespace pago::mapping
