// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "traffic.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "embree.hpp"
#include "pago/core/se3.hpp"

namespace pago::simulator {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

enum : std::uint64_t { kOncoming = 600, kCompany, kPedestrian, kPerson, kPassing };

constexpr double kStep_s = 0.05;  // between the poses that are worked out; 20 m/s: 1 m
constexpr double kReach_m = RayCaster::kSight_m + 10.0;
constexpr std::size_t kCarModels = 12, kPersonModels = 6;

}  // namespace

/// The movers' meshes, each with a tree of boxes of its own.
struct Traffic::Shapes {
  EmbreeDevice device = make_embree_device();
  std::vector<Model> models;
  std::vector<EmbreeScene> scenes;

  void add(Model model) {
    EmbreeScene scene(rtcNewScene(device.get()));
    attach_mesh(device.get(), scene.get(), model.mesh, Vector3d::Zero());
    commit(device.get(), scene.get());
    models.push_back(std::move(model));
    scenes.push_back(std::move(scene));
  }
};

Traffic::Traffic() = default;
Traffic::~Traffic() = default;

Traffic::Traffic(const TrafficStyle& style,
                 double density,
                 Way way,
                 std::vector<double> distances_m,
                 double interval_s,
                 const Ground* ground,
                 std::uint64_t seed)
    : way_(std::move(way)),
      distances_m_(std::move(distances_m)),
      interval_s_(interval_s),
      ground_(ground),
      shapes_(std::make_unique<Shapes>()) {
  constexpr std::array kShapes{CarShape::kHatchback, CarShape::kSaloon, CarShape::kVan, CarShape::kTruck};
  for (std::size_t i = 0; i < kCarModels; ++i) {
    const CarShape shape = kShapes[i % kShapes.size()];
    const Label label = shape == CarShape::kTruck ? Label::kMovingTruck : Label::kMovingCar;
    shapes_->add(car_model(shape, static_cast<std::uint8_t>(20 + 100 * (i / kShapes.size())), label));
  }
  for (std::size_t i = 0; i < kPersonModels; ++i) {
    Random random(seed, kPerson, i);
    shapes_->add(person_model(random, Label::kMovingPerson));
  }
  add_cars(style, density, seed);
  add_pedestrians(style, density, seed);
}

double Traffic::vehicle_m(double t_s) const noexcept {
  const double at = std::clamp(t_s / interval_s_, 0.0, static_cast<double>(distances_m_.size() - 1) - 1e-6);
  const auto i = std::min(static_cast<std::size_t>(at), distances_m_.size() - 2);
  return distances_m_[i] + (at - static_cast<double>(i)) * (distances_m_[i + 1] - distances_m_[i]);
}

void Traffic::add_cars(const TrafficStyle& style, double density, std::uint64_t seed) {
  constexpr double kSlot_s = 2.0, kAround_s = 40.0;
  const double end_s = interval_s_ * static_cast<double>(distances_m_.size());
  for (int slot = 0; slot * kSlot_s < end_s; ++slot) {
    Random random(seed, kOncoming, slot);
    if (!random.chance(style.oncoming_per_s * kSlot_s * density)) continue;
    const double meets_s = kSlot_s * (slot + random.unit()), meets_m = vehicle_m(meets_s);
    const double speed_m_s = random.between(style.oncoming_slow_m_s, style.oncoming_fast_m_s);
    movers_.push_back({static_cast<std::size_t>(random.below(kCarModels)),
                       [=](double t_s) { return meets_m - speed_m_s * (t_s - meets_s); },
                       style.oncoming_left_m, meets_s - kAround_s, meets_s + kAround_s});
  }
  for (int slot = 0; slot * kSlot_s < end_s; ++slot) {
    Random random(seed, kPassing, slot);
    if (!random.chance(style.passing_per_s * kSlot_s * density)) continue;
    const double meets_s = kSlot_s * (slot + random.unit()), meets_m = vehicle_m(meets_s);
    const double own_m_s = vehicle_m(meets_s + 0.5) - vehicle_m(meets_s - 0.5);
    const double speed_m_s = own_m_s + random.between(style.passing_slow_m_s, style.passing_fast_m_s);
    movers_.push_back({static_cast<std::size_t>(random.below(kCarModels)),
                       [=](double t_s) { return meets_m + speed_m_s * (t_s - meets_s); },
                       style.passing_left_m, meets_s - kAround_s, meets_s + kAround_s});
  }
  // Who drives ahead is where the vehicle itself will be in a moment, so it stops and turns as the vehicle
  // does.
  Random random(seed, kCompany);
  if (random.chance(style.leading * density)) {
    const double ahead_s = random.between(1.2, 2.5);
    movers_.push_back({static_cast<std::size_t>(random.below(kCarModels)),
                       [this, ahead_s](double t_s) { return vehicle_m(t_s + ahead_s) + 9.0; }, 0.0, 0.0,
                       end_s});
  }
  if (random.chance(style.following * density)) {
    const double behind_s = random.between(1.2, 2.5);
    movers_.push_back({static_cast<std::size_t>(random.below(kCarModels)),
                       [this, behind_s](double t_s) { return vehicle_m(t_s - behind_s) - 9.0; }, 0.0, 0.0,
                       end_s});
  }
}

void Traffic::add_pedestrians(const TrafficStyle& style, double density, std::uint64_t seed) {
  constexpr double kSlot_m = 10.0, kStroll_m = 20.0;
  for (int slot = 0; slot * kSlot_m < way_.length_m(); ++slot) {
    Random random(seed, kPedestrian, slot);
    if (!random.chance(style.pedestrians_per_m * kSlot_m * density)) continue;
    const double from_m = kSlot_m * (slot + random.unit()), speed_m_s = random.between(0.8, 1.6);
    const double phase_s = random.between(0.0, 100.0);
    // To and fro.
    const auto stroll = [=](double t_s) {
      const double walked = std::fmod((t_s + phase_s) * speed_m_s, 2.0 * kStroll_m);
      return from_m + std::min(walked, 2.0 * kStroll_m - walked);
    };
    const double left_m = random.chance(0.5) ? style.sidewalk_left_m + random.between(0.0, 1.0)
                                             : -style.sidewalk_right_m - random.between(0.0, 1.0);
    movers_.push_back(
        {kCarModels + static_cast<std::size_t>(random.below(kPersonModels)), stroll, left_m, -1e9, 1e9});
  }
}

Eigen::Isometry3d Traffic::pose(const Mover& mover, double t_s) const {
  constexpr double kHalfBase_m = 1.3;
  const double s = mover.along_m(t_s), later = mover.along_m(t_s + 0.1);
  const double forward = later < s ? -1.0 : 1.0;
  const Vector2d front = way_.beside(s + forward * kHalfBase_m, mover.left_m);
  const Vector2d rear = way_.beside(s - forward * kHalfBase_m, mover.left_m);
  const double front_m = ground_->height_m(front), rear_m = ground_->height_m(rear);
  const Vector2d ahead = front - rear;
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = (Eigen::AngleAxisd(std::atan2(ahead.y(), ahead.x()), Vector3d::UnitZ()) *
                Eigen::AngleAxisd(std::atan2(rear_m - front_m, ahead.norm()), Vector3d::UnitY()))
                   .toRotationMatrix();
  T.translation() << 0.5 * (front + rear), 0.5 * (front_m + rear_m);
  return T;
}

void Traffic::prepare(double t_s, const Vector3d& sensor) {
  const auto interval = static_cast<std::int64_t>(std::floor(t_s / kStep_s));
  if (movers_.empty() || interval == present_interval_) return;
  present_interval_ = interval;
  present_.clear();
  const double begin_s = kStep_s * static_cast<double>(interval), here_m = vehicle_m(t_s);
  constexpr std::size_t kMost = 64;  // bits of Candidates
  for (std::size_t i = 0; i < movers_.size() && present_.size() < kMost; ++i) {
    const Mover& mover = movers_[i];
    if (t_s < mover.from_s || t_s > mover.until_s || mover.along_m(t_s) < 3.0 ||
        mover.along_m(t_s) > way_.length_m() - 3.0)
      continue;
    if (std::abs(mover.along_m(t_s) - here_m) > 4.0 * kReach_m) continue;
    if ((way_.at(mover.along_m(t_s)) - sensor.head<2>()).norm() > kReach_m) continue;
    const Eigen::Isometry3d T = pose(mover, begin_s), T_next = pose(mover, begin_s + kStep_s);
    present_.push_back({i, T, (T_next.translation() - T.translation()) / kStep_s,
                        log_so3(T.linear().transpose() * T_next.linear()) / kStep_s});
  }
}

Traffic::Candidates Traffic::candidates(const RayPacket& rays,
                                        const Vector3d& origin,
                                        double t_s) const noexcept {
  // From the first ray of a packet to the last, and the width of a beam.
  const Vector3d way = rays.way(0).cast<double>();
  const double spread = (rays.way(RayPacket::kSize - 1) - rays.way(0)).cast<double>().norm() + 0.005;
  const Vector3d from = origin + rays.foot(0).cast<double>();
  const double since_s = t_s - kStep_s * static_cast<double>(present_interval_);
  Candidates result = 0;
  for (std::size_t k = 0; k < present_.size(); ++k) {
    const Present& present = present_[k];
    const Vector3d to = present.T_world_mover.translation() + since_s * present.velocity_m_s - from;
    const double along_m = to.dot(way);
    // About its bounding sphere; the mover's origin is on the ground in the middle of its box.
    const double radius_m =
        shapes_->models[movers_[present.mover].model].high.norm() + spread * std::abs(along_m);
    if (along_m < -radius_m || to.squaredNorm() - along_m * along_m > radius_m * radius_m) continue;
    result |= Candidates{1} << k;
  }
  return result;
}

Hit Traffic::cast(Candidates candidates,
                  const RayPacket& rays,
                  std::size_t i,
                  const Vector3d& origin,
                  double t_s,
                  float max_m) const noexcept {
  Hit nearest;
  const double since_s = t_s - kStep_s * static_cast<double>(present_interval_);
  const Vector3d from = origin + rays.foot(i).cast<double>(), way = rays.way(i).cast<double>();
  for (; candidates != 0; candidates &= candidates - 1) {
    const Present& present = present_[static_cast<std::size_t>(std::countr_zero(candidates))];
    const std::size_t model = movers_[present.mover].model;
    const Vector3d to = present.T_world_mover.translation() + since_s * present.velocity_m_s - from;
    const Eigen::Matrix3d R_world_mover =
        present.T_world_mover.linear() + present.T_world_mover.linear() * hat(since_s * present.turn_rad_s);
    const Eigen::Matrix3d R = R_world_mover.transpose();
    RTCRayHit query = one_ray((R * -to).cast<float>(), (R * way).cast<float>(), RayCaster::kNearest_m,
                              std::min(max_m, nearest.range_m));
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(shapes_->scenes[model].get(), &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
    const Vector3d normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
    nearest = {query.ray.tfar, (R_world_mover * normal).cast<float>(),
               shapes_->models[model].mesh.surfaces[query.hit.primID]};
  }
  return nearest;
}

}  // namespace pago::simulator
