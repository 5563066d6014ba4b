// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/firing_decoder.hpp"

#include <cmath>

#include "lanes.hpp"

namespace pago::hdl64 {
namespace {

// Where the two-point calibration was taken (S3 manual, p. 10).
constexpr double kFar_m = 25.04, kNearX_m = 2.40, kNearY_m = 1.93;
constexpr double kNearLimit_m = 25.0;  // beyond, the far point's distCorrection stands alone
constexpr double kFocalReach_m = 131.0;
constexpr std::int32_t kNever = 1 << 20;  // above every raw distance

/// The smallest raw distance, at least 1, whose range is not below `range_m`.
std::int32_t first_raw_at(double range_m, double distance_m, double lsb_m) {
  std::int32_t raw = 1;
  while (raw <= 0xFFFF && raw * lsb_m + distance_m < range_m) ++raw;
  return raw;
}

/// The largest raw distance whose range is not above `range_m`.
std::int32_t last_raw_at(double range_m, double distance_m, double lsb_m) {
  std::int32_t raw = 0xFFFF;
  while (raw > 0 && raw * lsb_m + distance_m > range_m) --raw;
  return raw;
}

}  // namespace

FiringDecoder::FiringDecoder(const Calibration& calibration, double min_range_m, double max_range_m)
    : distance_lsb_m_(static_cast<float>(calibration.distance_lsb_m)) {
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    fill_laser(calibration, laser);
    const LaserCalibration& from = calibration.lasers[laser];
    const double lsb_m = calibration.distance_lsb_m;
    valid_.first_raw[laser] = from.enabled ? first_raw_at(min_range_m, from.distance_m, lsb_m) : kNever;
    valid_.last_raw[laser] = last_raw_at(max_range_m, from.distance_m, lsb_m);
    valid_.ring[laser] = calibration.ring_of_laser[laser];
  }
}

void FiringDecoder::fill_laser(const Calibration& calibration, std::size_t laser) {
  const LaserCalibration& from = calibration.lasers[laser];
  const bool perpendicular = calibration.vertical_offset == VerticalOffset::kPerpendicular;
  const double cos_vertical = std::cos(from.vertical_rad), sin_vertical = std::sin(from.vertical_rad);
  const auto set = [laser](LaserTable::Lanes& lanes, double value) {
    lanes[laser] = static_cast<float>(value);
  };
  LaserTable& to = table_;
  set(to.distance_m, from.distance_m);
  set(to.near_slope_x, (from.distance_x_m - from.distance_m) / (kFar_m - kNearX_m));
  set(to.near_slope_y, (from.distance_y_m - from.distance_m) / (kFar_m - kNearY_m));
  set(to.cos_vertical, cos_vertical);
  set(to.sin_vertical, sin_vertical);
  set(to.cos_rotation, std::cos(from.rotation_rad));
  set(to.sin_rotation, std::sin(from.rotation_rad));
  set(to.xy_offset_m, perpendicular ? -from.vertical_offset_m * sin_vertical : 0.0);
  set(to.z_offset_m, perpendicular ? from.vertical_offset_m * cos_vertical : from.vertical_offset_m);
  set(to.horizontal_offset_m, from.horizontal_offset_m);
  set(to.time_s, laser_time_ns(static_cast<int>(laser)) * 1e-9);
  set(to.focal_offset, 256.0 * std::pow(1.0 - from.focal_distance_m / kFocalReach_m, 2));
  set(to.focal_slope, from.focal_slope);
  set(to.min_intensity, from.min_intensity);
  set(to.max_intensity, from.max_intensity);
  to.first_far_raw[laser] = first_raw_at(kNearLimit_m, from.distance_m, calibration.distance_lsb_m);
  corrects_intensity_ |= from.focal_slope != 0.0;
}

void FiringDecoder::decode(const PacketView& packet,
                           int firing,
                           const Rotation& rotation,
                           FiringReturns& out) const noexcept {
  FiringLanes lanes;  // NOLINT(*-member-init): the steps below write every entry that later ones read
  fastest::unpack(packet.slots(2 * firing), lanes.raw.data(), lanes.intensity.data());
  fastest::unpack(packet.slots(2 * firing + 1), lanes.raw.data() + kLasersPerBlock,
                  lanes.intensity.data() + kLasersPerBlock);
  place(rotation, lanes);
  if (corrects_intensity_) correct_intensity(lanes);
  fastest::compact(lanes, valid_, out);
}

// The manual's formulas (x right, y forward), in single precision: sine and cosine of the head's azimuth are
// taken once, in double; rotCorrection and the rotation until the laser fires (below 6 mrad at 20 Hz) turn
// them on, the latter by a series whose error is below 1e-10.
void FiringDecoder::place(const Rotation& rotation, FiringLanes& __restrict lanes) const noexcept {
  const LaserTable& __restrict t = table_;
  const float lsb_m = distance_lsb_m_;
  const auto cos_head = static_cast<float>(std::cos(rotation.azimuth_rad));
  const auto sin_head = static_cast<float>(std::sin(rotation.azimuth_rad));
  const auto rate_rad_s = static_cast<float>(rotation.rate_rad_s);
  constexpr auto kFar = static_cast<float>(kFar_m);
  for (std::size_t i = 0; i < kLasers; ++i) {
    const float turn = rate_rad_s * t.time_s[i], turn_sq = turn * turn;
    const float cos_turn = 1.0F - 0.5F * turn_sq, sin_turn = turn - turn * turn_sq * (1.0F / 6.0F);
    const float cos_start = cos_head * t.cos_rotation[i] + sin_head * t.sin_rotation[i];
    const float sin_start = sin_head * t.cos_rotation[i] - cos_head * t.sin_rotation[i];
    const float c = cos_start * cos_turn - sin_start * sin_turn;
    const float s = sin_start * cos_turn + cos_start * sin_turn;

    const float d = static_cast<float>(lanes.raw[i]) * lsb_m + t.distance_m[i];
    const float xy = d * t.cos_vertical[i] + t.xy_offset_m[i];
    const float hc = t.horizontal_offset_m[i] * c, hs = t.horizontal_offset_m[i] * s;
    const float near = lanes.raw[i] < t.first_far_raw[i] ? 1.0F : 0.0F;
    const float near_x = near * t.near_slope_x[i] * (kFar - std::abs(xy * s - hc));
    const float near_y = near * t.near_slope_y[i] * (kFar - std::abs(xy * c + hs));
    lanes.x_m[i] = (xy + near_y * t.cos_vertical[i]) * c + hs;
    lanes.y_m[i] = hc - (xy + near_x * t.cos_vertical[i]) * s;
    lanes.z_m[i] = (d + near_y) * t.sin_vertical[i] + t.z_offset_m[i];
  }
}

// I + slope * |256 (1 - focal distance / 131 m)^2 - 256 (1 - raw / 65535)^2|, within the laser's limits.
void FiringDecoder::correct_intensity(FiringLanes& __restrict lanes) const noexcept {
  const LaserTable& __restrict t = table_;
  for (std::size_t i = 0; i < kLasers; ++i) {
    const float away = 1.0F - static_cast<float>(lanes.raw[i]) * (1.0F / 65535.0F);
    const float added = t.focal_slope[i] * std::abs(t.focal_offset[i] - 256.0F * away * away);
    float value = static_cast<float>(lanes.intensity[i]) + added;
    value = value < t.min_intensity[i] ? t.min_intensity[i] : value;
    value = value > t.max_intensity[i] ? t.max_intensity[i] : value;
    // value >= 0; lround() would keep this loop from becoming vector code
    lanes.intensity[i] = static_cast<std::int32_t>(value + 0.5F);  // NOLINT(bugprone-incorrect-roundings)
  }
}

}  // namespace pago::hdl64
