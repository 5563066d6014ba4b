// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sensor.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials.hpp"
#include "pago/core/se3.hpp"
#include "roof.hpp"

namespace pago::simulator {
namespace {

enum : std::uint64_t { kBeam = 700, kGain };

/// Half the width of a beam (2 mrad, S2 manual).
constexpr double kSpread_rad = 0.001;
/// Surfaces farther apart than this, across the first, are two echoes and not one that is rough.
constexpr double kEdge_m = 0.1;

/// What a beam meets: a mover, or what stands still, through whatever lets it pass.
Hit meet(const RayCaster& scene,
         const Traffic& traffic,
         Traffic::Candidates movers,
         const RayPacket& rays,
         std::size_t i,
         Hit hit,
         double t_s,
         Random& random) {
  constexpr int kMostPanes = 4;
  constexpr float kBeyond_m = 0.01F;
  for (int pane = 0; pane < kMostPanes && hit.is_there(); ++pane) {
    const double transmission = optics(hit.surface.material).transmission;
    if (transmission == 0.0 || !random.chance(transmission)) break;
    hit = scene.cast_on(rays, i, hit.range_m + kBeyond_m);
  }
  if (movers == 0) return hit;
  const Hit mover = traffic.cast(movers, rays, i, scene.origin(), t_s, std::min(hit.range_m, 1e6F));
  if (!mover.is_there() || random.chance(optics(mover.surface.material).transmission)) return hit;
  return mover;
}

/// Whether two rays of one beam meet different things: one of them nothing, or a point off the other's plane.
bool is_edge(const Eigen::Vector3f& way, const Hit& hit, const Eigen::Vector3f& other_way, const Hit& other) {
  if (hit.is_there() != other.is_there()) return true;
  if (!hit.is_there()) return false;
  const Eigen::Vector3f between = other.range_m * other_way - hit.range_m * way;
  return std::abs(hit.normal.dot(between)) > static_cast<float>(kEdge_m) * hit.normal.norm();
}

}  // namespace

Sensor::Sensor(SensorSetup setup, const Trajectory& T_world_base)
    : setup_(std::move(setup)),
      trajectory_(T_world_base),
      head_(setup_.rotation_hz, setup_.head_stops_at_s),
      stands_(kBlock + 1) {
  for (std::size_t laser = 0; laser < lines_.size(); ++laser) {
    lines_[laser] = LaserLine(setup_.unit.lasers[laser], setup_.unit);
    // As rings of KITTI's drives differ: by a quarter in intensity, and by up to 1 % in what they lose.
    Random random(setup_.seed, kGain, laser);
    optics_[laser].gain = std::exp(0.25 * random.normal());
    optics_[laser].always_lost = setup_.has_dropouts ? random.between(0.0, 0.01) : 0.0;
  }
}

void Sensor::take_stand(std::int64_t first) {
  for (int k = 0; k <= kBlock; ++k) {
    Stand& stand = stands_[static_cast<std::size_t>(k)];
    const double t_s = firing_s(first + k);
    const Eigen::Isometry3d T = T_world_sensor(t_s);
    stand.rotation = T.linear();
    stand.position = T.translation();
    const double azimuth_rad = 2.0 * std::numbers::pi * head_.revolutions(t_s);
    stand.cos_azimuth = std::cos(azimuth_rad);
    stand.sin_azimuth = std::sin(azimuth_rad);
    if (k == 0) continue;
    Stand& before = stands_[static_cast<std::size_t>(k - 1)];
    before.step = stand.position - before.position;
    before.turn = log_so3(before.rotation.transpose() * stand.rotation);
  }
  const double rate_rad_s = 2.0 * std::numbers::pi * head_.rate_rev_s(firing_s(first));
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    const double late_s = setup_.timing.laser_ns(static_cast<int>(laser)) * 1e-9;
    const double delta_rad = rate_rad_s * late_s - setup_.unit.lasers[laser].rotation_rad;
    cos_delta_[laser] = std::cos(delta_rad);
    sin_delta_[laser] = std::sin(delta_rad);
  }
}

// Between two firings the sensor moves evenly: over 48 us that is exact to a nanometre.
void Sensor::aim(Volley& volley, const Eigen::Vector3d& origin) const {
  const std::size_t laser = volley.laser;
  const std::int32_t late_ns = setup_.timing.laser_ns(static_cast<int>(laser));
  const double share = late_ns / static_cast<double>(setup_.timing.period_ns);
  for (std::size_t i = 0; i < volley.beams.size(); ++i) {
    const Stand& stand = stands_[volley.from + i];
    const std::int64_t firing = volley.first + static_cast<std::int64_t>(volley.from + i);
    volley.random[i] = Random(setup_.seed, kBeam, firing, laser);
    Beam& beam = volley.beams[i];
    beam.t_s = firing_s(firing) + late_ns * 1e-9;
    beam.heading = {stand.cos_azimuth * cos_delta_[laser] - stand.sin_azimuth * sin_delta_[laser],
                    stand.sin_azimuth * cos_delta_[laser] + stand.cos_azimuth * sin_delta_[laser]};
    beam.line = lines_[laser].far(beam.heading);
    beam.R_world_sensor = stand.rotation + stand.rotation * hat(share * stand.turn);
    const Eigen::Vector3d foot =
        stand.position + share * stand.step + beam.R_world_sensor * beam.line.foot - origin;
    volley.rays.set_foot(i, foot.cast<float>());
    volley.rays.set_way(i, (beam.R_world_sensor * beam.line.step).cast<float>());
  }
}

// The same beams turned aside a little, each somewhere within its own width.
void Sensor::spread(Volley& volley) const {
  volley.aside = volley.rays;
  for (std::size_t i = 0; i < volley.beams.size(); ++i) {
    const Beam& beam = volley.beams[i];
    Random& random = volley.random[i];
    const Eigen::Vector3d& step = beam.line.step;
    const Eigen::Vector3d across(beam.heading.sin, beam.heading.cos, 0.0);
    const double aside = random.between(-kSpread_rad, kSpread_rad);
    const double up = random.between(-kSpread_rad, kSpread_rad);
    const Eigen::Vector3d turned = step + aside * across + up * step.cross(across);
    volley.aside.set_way(i, (beam.R_world_sensor * turned).normalized().cast<float>());
  }
}

// What stands out of its triangle is met earlier, by more the flatter the beam comes in.
Echo Sensor::echo_of(const Volley& volley,
                     std::size_t i,
                     const RayPacket& rays,
                     const Hit& hit,
                     const Eigen::Vector3d& origin) const noexcept {
  const Beam& beam = volley.beams[i];
  const Eigen::Vector3d at = origin + (rays.foot(i) + hit.range_m * rays.way(i)).cast<double>();
  const double cos_incidence = std::abs(double{hit.normal.normalized().dot(rays.way(i))});
  const double rise_m = setup_.has_uneven_ground ? relief_m(hit.surface.material, at.x(), at.y()) : 0.0;
  const double range_m = double{hit.range_m} - rise_m / std::max(kLeastCosIncidence, cos_incidence);
  const Eigen::Vector3d normal = beam.R_world_sensor.transpose() * hit.normal.cast<double>();
  return {.range_m = lines_[volley.laser].measured_m(beam.heading, range_m, normal),
          .cos_incidence = cos_incidence,
          .surface = hit.surface};
}

Returns Sensor::sense(Volley& volley, std::size_t i, const RayCaster& scene, const Traffic& traffic) const {
  if (setup_.has_roof && meets_roof(setup_.T_base_sensor.linear() * volley.beams[i].line.step)) return {};
  Random& random = volley.random[i];
  const double t_s = volley.beams[i].t_s;
  std::array<Echo, 2> echoes;
  std::size_t n = 0;
  const Hit hit = meet(scene, traffic, volley.movers, volley.rays, i, volley.hits[i], t_s, random);
  if (hit.is_there()) echoes[n++] = echo_of(volley, i, volley.rays, hit, scene.origin());
  if (setup_.has_wide_beams) {
    const Hit other = meet(scene, traffic, volley.movers, volley.aside, i, volley.aside_hits[i], t_s, random);
    const double share = random.between(0.0, 0.5);
    if (is_edge(volley.rays.way(i), hit, volley.aside.way(i), other)) {
      if (n > 0) echoes[0].share = 1.0 - share;
      if (other.is_there()) {
        echoes[n] = echo_of(volley, i, volley.aside, other, scene.origin());
        echoes[n++].share = share;
      }
    }
  }
  return returns_of(setup_.returns, echoes, n, optics_[volley.laser], random);
}

// The decoder adds the focal correction (hdl64/packet_decoder.cpp); the unit sends what is left without it.
Slot Sensor::slot_of(std::size_t laser, const Return& from) const noexcept {
  constexpr double kFocalReach_m = 131.0;
  if (!from.is_there) return {};
  const double raw = std::round(lines_[laser].raw(from.range_m));
  if (raw < 1.0 || raw > 65535.0) return {};
  const hdl64::LaserCalibration& figures = setup_.unit.lasers[laser];
  const double focal = 1.0 - figures.focal_distance_m / kFocalReach_m, away = 1.0 - raw / 65535.0;
  const double added = figures.focal_slope * std::abs(256.0 * focal * focal - 256.0 * away * away);
  const double intensity = std::clamp(from.intensity - added, 0.0, 255.0);
  return {static_cast<std::uint16_t>(raw), static_cast<std::uint8_t>(std::lround(intensity)), from.label};
}

void Sensor::fire(std::int64_t first,
                  RayCaster& scene,
                  Traffic& traffic,
                  std::span<FiringSlots, kBlock> slots) {
  take_stand(first);
  scene.move_to(stands_[0].position);
  traffic.prepare(firing_s(first), stands_[0].position);
  Volley volley;
  volley.first = first;
  for (volley.laser = 0; volley.laser < hdl64::kLasers; ++volley.laser) {
    for (volley.from = 0; volley.from < kBlock; volley.from += RayPacket::kSize) {
      aim(volley, scene.origin());
      scene.cast(volley.rays, volley.hits);
      volley.movers = traffic.candidates(volley.rays, scene.origin(), volley.beams[0].t_s);
      if (setup_.has_wide_beams) {
        spread(volley);
        scene.cast(volley.aside, volley.aside_hits);
      }
      for (std::size_t i = 0; i < RayPacket::kSize; ++i) {
        const Returns returns = sense(volley, i, scene, traffic);
        for (std::size_t k = 0; k < returns.size(); ++k)
          slots[volley.from + i][k][volley.laser] = slot_of(volley.laser, returns[k]);
      }
    }
  }
}

}  // namespace pago::simulator
