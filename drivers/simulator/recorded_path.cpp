// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "recorded_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "heights.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/evaluation/trajectory.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kJump_m = 7.0;   // from pose to pose: 250 km/h
constexpr double kApart_m = 1.5;  // between the poses that shape the way: standing still shapes nothing
constexpr int kFine = 4;          // points of the way for each of them
constexpr double kStreet_m = 120.0;

/// Of the vehicle: below the laser scanner, on the ground (KITTI's sensor set-up).
Eigen::Isometry3d T_camera_base() {
  Eigen::Isometry3d T = evaluation::T_camera_sensor_axes();
  T.translation() << 0.0, 1.65, -0.27;
  return T;
}

std::vector<Eigen::Isometry3d> read_poses(const std::filesystem::path& file) {
  const evaluation::Trajectory camera = evaluation::read_trajectory(file);
  if (camera.has_stamps())
    throw Error(file.string(), "has stamps; a path to drive along has 12 numbers a line and no stamps");
  const Eigen::Isometry3d T_world_camera_axes = evaluation::T_camera_sensor_axes().inverse();
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(camera.poses.size());
  for (const evaluation::StampedPose& pose : camera.poses)
    poses.push_back(T_world_camera_axes * pose.T_world_sensor * T_camera_base());
  return poses;
}

/// Poses that are some way apart, and for every pose its place among them: 2.5 is halfway from the third to
/// the fourth.
struct Thinned {
  std::vector<Vector3d> points;
  std::vector<double> place_of_pose;
};

Thinned thin(const std::filesystem::path& file, const std::vector<Eigen::Isometry3d>& poses) {
  Thinned result{{poses.front().translation()}, std::vector<double>(poses.size(), 0.0)};
  std::size_t first = 0;  // pose of the last point
  const auto refuse = [&](std::size_t i, const std::string& what) {
    throw Error(file.string() + ":" + std::to_string(i + 1), what,
                "give a path that goes forwards, 10 poses a second: x right, y down, z forward, of a camera "
                "that looks ahead");
  };
  for (std::size_t i = 1; i < poses.size(); ++i) {
    const double apart_m = (poses[i].translation() - poses[i - 1].translation()).norm();
    if (apart_m > kJump_m) refuse(i, format("is %.1f m from the pose before", apart_m));
    const Vector3d step = poses[i].translation() - result.points.back();
    if (step.norm() < kApart_m) continue;
    const double ahead = step.dot(poses[first].linear().col(0)) / step.norm();
    if (ahead < 0.5) refuse(i, ahead < -0.5 ? "drives backwards" : "drives sideways");
    const auto place = static_cast<double>(result.points.size() - 1);
    for (std::size_t k = first + 1; k <= i; ++k) {
      const double share = step.dot(poses[k].translation() - result.points.back()) / step.squaredNorm();
      result.place_of_pose[k] = std::max(result.place_of_pose[k - 1], place + std::clamp(share, 0.0, 1.0));
    }
    result.points.push_back(poses[i].translation());
    first = i;
  }
  for (std::size_t k = first + 1; k < poses.size(); ++k)
    result.place_of_pose[k] = result.place_of_pose[first];
  return result;
}

/// Cubic B-spline weights of four control values.
std::array<double, 4> spline_weights(double u) {
  const double v = 1.0 - u;
  return {v * v * v / 6.0, (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0,
          (1.0 + 3.0 * u + 3.0 * u * u - 3.0 * u * u * u) / 6.0, u * u * u / 6.0};
}

template <typename Value>
Value spline(const std::vector<Value>& control, double at) {
  const auto last = static_cast<std::ptrdiff_t>(control.size()) - 1;
  const auto i = std::clamp(static_cast<std::ptrdiff_t>(std::floor(at)), std::ptrdiff_t{0}, last);
  const std::array<double, 4> weights = spline_weights(std::clamp(at - static_cast<double>(i), 0.0, 1.0));
  // Beyond an end the values go on in a straight line, so that the spline meets the end.
  const auto value = [&](std::ptrdiff_t k) -> Value {
    if (k < 0) return 2.0 * control.front() - control[static_cast<std::size_t>(std::min(-k, last))];
    if (k > last)
      return 2.0 * control.back() -
             control[static_cast<std::size_t>(std::max(2 * last - k, std::ptrdiff_t{0}))];
    return control[static_cast<std::size_t>(k)];
  };
  return weights[0] * value(i - 1) + weights[1] * value(i) + weights[2] * value(i + 1) +
         weights[3] * value(i + 2);
}

/// How far along a line the point of its pieces [from, to) is that is nearest to `at`.
double nearest_m(const std::vector<Vector2d>& line,
                 const std::vector<double>& length,
                 std::size_t from,
                 std::size_t to,
                 const Vector2d& at) {
  double nearest_sq = std::numeric_limits<double>::infinity(), result_m = 0.0;
  for (std::size_t i = from; i < to; ++i) {
    const Vector2d piece = line[i + 1] - line[i];
    const double share =
        std::clamp((at - line[i]).dot(piece) / std::max(1e-12, piece.squaredNorm()), 0.0, 1.0);
    const double apart_sq = (at - line[i] - share * piece).squaredNorm();
    if (apart_sq >= nearest_sq) continue;
    nearest_sq = apart_sq;
    result_m = length[i] + share * (length[i + 1] - length[i]);
  }
  return result_m;
}

/// Recorded poses leap to and fro by centimetres, which at ten a second are accelerations that no vehicle
/// has, and would pitch it like bumps: a mean over some tenths of a second, with the ends where they were.
std::vector<double> smoothed(const std::vector<double>& distances_m) {
  constexpr double kDeviation = 3.0;  // poses
  constexpr int kReach = 9;
  const auto last = static_cast<int>(distances_m.size()) - 1;
  const auto at = [&](int i) {
    if (i < 0) return 2.0 * distances_m.front() - distances_m[static_cast<std::size_t>(std::min(-i, last))];
    if (i > last)
      return 2.0 * distances_m.back() - distances_m[static_cast<std::size_t>(std::max(2 * last - i, 0))];
    return distances_m[static_cast<std::size_t>(i)];
  };
  std::vector<double> result;
  for (int i = 0; i <= last; ++i) {
    double sum = 0.0, weights = 0.0;
    for (int k = -kReach; k <= kReach; ++k) {
      const double weight = std::exp(-0.5 * k * k / (kDeviation * kDeviation));
      sum += weight * at(i + k), weights += weight;
    }
    result.push_back(sum / weights);
  }
  return result;
}

/// The street whose right lane the way is, with the way's heights.
std::vector<StreetPoint> street_beside(const Way& way,
                                       const std::vector<double>& way_length,
                                       double left_m,
                                       const std::vector<double>& heights) {
  std::vector<Vector2d> middle;
  std::vector<double> length;
  for (const double s : way_length) {
    const Vector2d p = way.beside(s, left_m);
    length.push_back(middle.empty() ? 0.0 : length.back() + (p - middle.back()).norm());
    middle.push_back(p);
  }
  std::vector<StreetPoint> street = street_along(middle, 0);
  for (StreetPoint& point : street) {
    const auto after = std::ranges::upper_bound(length, point.from_start_m) - length.begin();
    const auto i = std::clamp<std::size_t>(static_cast<std::size_t>(after), 1, length.size() - 1);
    const double share = (point.from_start_m - length[i - 1]) / std::max(1e-9, length[i] - length[i - 1]);
    point.z_m = heights[i - 1] + share * (heights[i] - heights[i - 1]);
  }
  return street;
}

/// Marks what goes along an earlier stretch, and gives every stretch a number of its own.
void split_streets(std::vector<StreetPoint>& points) {
  const StreetMap map(points);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const std::uint32_t j : map.around(points[i].at)) {
      const bool is_earlier = points[i].from_start_m - points[j].from_start_m > 60.0;
      const double apart_m = (points[i].at - points[j].at).norm();
      if (is_earlier && apart_m < 6.0 && std::abs(points[i].along.dot(points[j].along)) > 0.8)
        points[i].is_furnished = false;
    }
  }
  double begin_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    points[i].street = points[i - 1].street;
    const bool changes = points[i].is_furnished != points[i - 1].is_furnished;
    if (changes || points[i].from_start_m - begin_m > kStreet_m) {
      ++points[i].street;
      begin_m = points[i].from_start_m;
    }
  }
  for (std::size_t i = 0; i < points.size();) {
    std::size_t end = i;
    const double from_m = points[i].from_start_m;
    for (; end < points.size() && points[end].street == points[i].street; ++end)
      points[end].from_start_m -= from_m;
    i = end;
  }
}

}  // namespace

double RecordedPath::distance_m(double t_s) const noexcept {
  return spline(distances_m, t_s / kInterval_s);
}

RecordedPath read_path(const std::filesystem::path& file, double half_width_m, double lane_m) {
  const std::vector<Eigen::Isometry3d> poses = read_poses(file);
  const Thinned thinned = thin(file, poses);
  constexpr std::size_t kFewest = 10;
  if (thinned.points.size() < kFewest)
    throw Error(file.string(), "is a path of less than " +
                                   std::to_string(static_cast<int>(kFewest * kApart_m)) +
                                   " m: too short to drive along");
  std::vector<Vector2d> line;
  std::vector<double> heights, length{0.0};
  for (std::size_t k = 0; k <= kFine * (thinned.points.size() - 1); ++k) {
    const Vector3d p = spline(thinned.points, static_cast<double>(k) / kFine);
    if (!line.empty()) length.push_back(length.back() + (p.head<2>() - line.back()).norm());
    line.emplace_back(p.head<2>());
    heights.push_back(p.z());
  }
  std::vector<double> distances_m;
  for (std::size_t k = 0; k < poses.size(); ++k) {
    const auto piece = static_cast<std::size_t>(kFine * thinned.place_of_pose[k]);
    const double here_m =
        nearest_m(line, length, piece - std::min<std::size_t>(piece, kFine),
                  std::min(piece + 2 * kFine, line.size() - 1), poses[k].translation().head<2>());
    distances_m.push_back(distances_m.empty() ? here_m : std::max(distances_m.back(), here_m));
  }

  RecordedPath path;
  path.distances_m = smoothed(distances_m);
  path.route.way = Way(std::move(line));
  path.route.streets = street_beside(path.route.way, length, lane_m, heights);
  std::vector<StreetPoint>& street = path.route.streets;
  for (StreetPoint& point : street) point.half_width_m = half_width_m;
  agree_on_heights(street);
  split_streets(street);
  return path;
}

}  // namespace pago::simulator
