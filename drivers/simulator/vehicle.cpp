// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vehicle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "pago/core/se3.hpp"
#include "pago/core/units.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;

enum : std::uint64_t { kWander = 900 };

constexpr double kGrid_m = 0.5;
constexpr double kHalfWheelbase_m = 1.35, kHalfTrack_m = 0.78;
// A passenger car's body on its springs, and how far it leans under a metre per second squared.
constexpr double kBounce_hz = 1.4, kDamping = 0.35;
constexpr double kLeanPitch_rad = 0.35 * kDegree, kLeanRoll_rad = 0.45 * kDegree;

/// A mass on a spring and a damper whose foot moves.
class Spring {
 public:
  explicit Spring(double foot) : foot_(foot), x_(foot) {}
  double follow(double foot, double dt_s) {
    constexpr int kSteps = 4;
    constexpr double omega = 2.0 * std::numbers::pi * kBounce_hz;
    const double dt = dt_s / kSteps, foot_speed = (foot - foot_) / dt_s;
    for (int i = 0; i < kSteps; ++i) {
      foot_ += foot_speed * dt;
      v_ += dt * (omega * omega * (foot_ - x_) + 2.0 * kDamping * omega * (foot_speed - v_));
      x_ += dt * v_;
    }
    return x_;
  }

 private:
  double foot_, x_, v_ = 0.0;
};

constexpr double kFromEnd_m = 5.0;  // the axles need some way before and behind the middle

/// The highest speed at each kGrid_m of the way: bends, stops, and what brakes and engine allow.
std::vector<double> speed_limits(const Way& way, std::span<const double> stops_m, const Pace& pace) {
  const auto count = static_cast<std::size_t>(way.length_m() / kGrid_m);
  std::vector<double> limit(count, pace.cruise_m_s);
  for (std::size_t i = 4; i + 4 < count; ++i) {
    const double s = static_cast<double>(i) * kGrid_m, h = 2.0;
    const Vector2d before = way.at(s) - way.at(s - h), after = way.at(s + h) - way.at(s);
    const double turn = std::atan2(before.x() * after.y() - before.y() * after.x(), before.dot(after));
    const double curvature = std::abs(turn) / h;
    if (curvature > 1e-6) limit[i] = std::min(limit[i], std::sqrt(pace.lateral_m_s2 / curvature));
  }
  for (const double stop_m : stops_m) {
    const auto i = static_cast<std::size_t>(std::max(0.0, stop_m / kGrid_m));
    if (i < count) limit[i] = 0.0;
  }
  constexpr auto kFirst = static_cast<std::size_t>(kFromEnd_m / kGrid_m);
  limit[kFirst] = std::min(limit[kFirst], pace.start_m_s);
  for (std::size_t i = kFirst + 1; i < count; ++i)
    limit[i] =
        std::min(limit[i], std::sqrt(limit[i - 1] * limit[i - 1] + 2.0 * pace.accelerate_m_s2 * kGrid_m));
  for (std::size_t i = count - 1; i-- > 0;)
    limit[i] = std::min(limit[i], std::sqrt(limit[i + 1] * limit[i + 1] + 2.0 * pace.brake_m_s2 * kGrid_m));
  return limit;
}

/// Nobody steers along a line: how far to the left of it the vehicle is.
double wander_m(std::uint64_t seed, double s_m, double every_m) {
  if (every_m <= 0.0) return 0.0;
  return 0.12 * noise(hash(seed, kWander), s_m, 0.0, every_m) +
         0.03 * noise(hash(seed, kWander, 1), s_m, 0.0, 0.4 * every_m);
}

/// Turn rate, from the change of heading; and the rate of the speed.
struct Dynamics {
  double along_m_s2 = 0.0, left_m_s2 = 0.0;
};

Dynamics dynamics_at(const Way& way, std::span<const double> s_m, std::size_t i, double dt_s) {
  if (i == 0 || i + 1 >= s_m.size()) return {};
  const Vector2d before = way.at(s_m[i] - 1.0), here = way.at(s_m[i]), after = way.at(s_m[i] + 1.0);
  const Vector2d u = here - before, v = after - here;
  const double curvature = std::atan2(u.x() * v.y() - u.y() * v.x(), u.dot(v));
  const double speed = (s_m[i + 1] - s_m[i - 1]) / (2.0 * dt_s);
  // Stops are abrupt at the last few centimetres per second; tyres give way there.
  const double along = std::clamp((s_m[i + 1] - 2.0 * s_m[i] + s_m[i - 1]) / (dt_s * dt_s), -6.0, 6.0);
  return {along, curvature * speed * speed};
}

}  // namespace

std::vector<double> distances_driven(
    const Way& way, std::span<const double> stops_m, const Pace& pace, double interval_s, double seconds) {
  constexpr double kCreep_m_s = 0.4;  // so that stops and starts are reached at all
  const std::vector<double> limit = speed_limits(way, stops_m, pace);
  std::vector<double> distances;
  double s = kFromEnd_m, waits_s = 0.0;
  std::size_t next_stop = 0;
  while (next_stop < stops_m.size() && stops_m[next_stop] <= s) ++next_stop;
  const auto count = static_cast<std::size_t>(std::ceil(seconds / interval_s)) + 1;
  while (distances.size() < count && s < way.length_m() - kFromEnd_m) {
    distances.push_back(s);
    if (waits_s > 0.0) {
      waits_s -= interval_s;
      continue;
    }
    const double at = s / kGrid_m;
    const auto i = std::min(static_cast<std::size_t>(at), limit.size() - 2);
    // Steady acceleration from grid point to grid point: the square of the speed is linear in the distance.
    const double share = at - static_cast<double>(i);
    const double speed = std::sqrt(limit[i] * limit[i] * (1.0 - share) + limit[i + 1] * limit[i + 1] * share);
    s += interval_s * std::max(kCreep_m_s, speed);
    if (next_stop < stops_m.size() && s >= stops_m[next_stop]) {
      waits_s = pace.stop_s;
      ++next_stop;
    }
  }
  return distances;
}

std::vector<Eigen::Isometry3d> drive_over(const Ground& ground,
                                          const Way& way,
                                          std::span<const double> distances_m,
                                          double interval_s,
                                          double corrects_every_m,
                                          std::uint64_t seed) {
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(distances_m.size());
  std::vector<Spring> springs;  // height, pitch, roll
  for (std::size_t i = 0; i < distances_m.size(); ++i) {
    const auto axle_at = [&](double s_m) { return way.beside(s_m, wander_m(seed, s_m, corrects_every_m)); };
    const Vector2d rear = axle_at(distances_m[i] - kHalfWheelbase_m);
    const Vector2d front = axle_at(distances_m[i] + kHalfWheelbase_m);
    const Vector2d ahead = (front - rear).normalized(), left(-ahead.y(), ahead.x());
    const auto wheel = [&](const Vector2d& axle, double side) {
      return ground.road_height_m(ground.spot(axle + side * kHalfTrack_m * left));
    };
    const double fl = wheel(front, 1.0), fr = wheel(front, -1.0), rl = wheel(rear, 1.0),
                 rr = wheel(rear, -1.0);
    const Dynamics g = dynamics_at(way, distances_m, i, interval_s);
    // Nose up when it speeds up, outward in bends.
    const std::array feet{
        0.25 * (fl + fr + rl + rr),
        std::atan2(0.5 * (rl + rr - fl - fr), 2.0 * kHalfWheelbase_m) - kLeanPitch_rad * g.along_m_s2,
        std::atan2(0.5 * (fl + rl - fr - rr), 2.0 * kHalfTrack_m) + kLeanRoll_rad * g.left_m_s2};
    if (springs.empty()) springs = {Spring(feet[0]), Spring(feet[1]), Spring(feet[2])};
    const double z = springs[0].follow(feet[0], interval_s);
    const double pitch = springs[1].follow(feet[1], interval_s),
                 roll = springs[2].follow(feet[2], interval_s);
    Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
    T.linear() = rotation({roll, pitch, std::atan2(ahead.y(), ahead.x())});
    T.translation() << 0.5 * (front + rear), z;
    poses.push_back(T);
  }
  return poses;
}

}  // namespace pago::simulator
