// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/packet_decoder.hpp"

#include <algorithm>
#include <cmath>

#include "lanes.hpp"
#include "pago/core/sweep.hpp"

namespace pago::hdl64 {
namespace {

// Where the two-point calibration was taken (S3 manual, p. 10).
constexpr double kFar_m = 25.04, kNearX_m = 2.40, kNearY_m = 1.93;
constexpr double kNearLimit_m = 25.0;  // beyond, the far point's distCorrection stands alone
constexpr double kFocalReach_m = 131.0;
constexpr std::int32_t kNever = 1 << 20;  // above every raw distance

/// A raw distance within one of where its range is `range_m`.
std::int32_t raw_near(double range_m, double distance_m, double lsb_m) {
  return static_cast<std::int32_t>(std::clamp((range_m - distance_m) / lsb_m, 0.0, 65'536.0));
}

/// The smallest raw distance, at least 1, whose range is not below `range_m`.
std::int32_t first_raw_at(double range_m, double distance_m, double lsb_m) {
  std::int32_t raw = std::max(1, raw_near(range_m, distance_m, lsb_m) - 1);
  while (raw <= 0xFFFF && raw * lsb_m + distance_m < range_m) ++raw;
  return raw;
}

/// The largest raw distance whose range is not above `range_m`.
std::int32_t last_raw_at(double range_m, double distance_m, double lsb_m) {
  std::int32_t raw = std::min(0xFFFF, raw_near(range_m, distance_m, lsb_m) + 1);
  while (raw > 0 && raw * lsb_m + distance_m > range_m) --raw;
  return raw;
}

/// A direction that is turned on by small angles, without sine and cosine each time: below 0.1 rad the
/// series are exact to 1e-11.
struct Direction {
  double cosine, sine;

  void turn(double angle_rad) noexcept {
    const double sq = angle_rad * angle_rad;
    const double c = 1.0 - sq * (1.0 / 2.0) * (1.0 - sq * (1.0 / 12.0));
    const double s = angle_rad * (1.0 - sq * (1.0 / 6.0) * (1.0 - sq * (1.0 / 20.0)));
    *this = {cosine * c - sine * s, sine * c + cosine * s};
  }
};

}  // namespace

PacketDecoder::PacketDecoder(const Calibration& calibration, double min_range_m, double max_range_m)
    : distance_lsb_m_(static_cast<float>(calibration.distance_lsb_m)) {
  for (std::size_t laser = 0; laser < kLasers; ++laser)
    fill_laser(calibration, laser, min_range_m, max_range_m);
  set_power_level(calibration.power_level);
  set_format({});
}

void PacketDecoder::fill_laser(const Calibration& calibration,
                               std::size_t laser,
                               double min_range_m,
                               double max_range_m) {
  const LaserCalibration& from = calibration.lasers[laser];
  const bool perpendicular = calibration.vertical_offset == VerticalOffset::kPerpendicular;
  const double cos_vertical = std::cos(from.vertical_rad), sin_vertical = std::sin(from.vertical_rad);
  const double lsb_m = calibration.distance_lsb_m;
  const auto set = [laser](Lanes& lanes, double value) { lanes[laser] = static_cast<float>(value); };
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
  set(to.focal_offset, 256.0 * std::pow(1.0 - from.focal_distance_m / kFocalReach_m, 2));
  set(to.focal_slope, from.focal_slope);
  set(to.min_intensity, from.min_intensity);
  set(to.max_intensity, from.max_intensity);
  to.first_far_raw[laser] = first_raw_at(kNearLimit_m, from.distance_m, lsb_m);
  to.first_raw[laser] = from.enabled ? first_raw_at(min_range_m, from.distance_m, lsb_m) : kNever;
  to.last_raw[laser] = last_raw_at(max_range_m, from.distance_m, lsb_m);
  has_focal_slopes_ |= from.focal_slope != 0.0;
}

void PacketDecoder::set_format(const StreamFormat& format) noexcept {
  format_ = format;
  set_block_times(format.block_times_ns(), 0);
}

void PacketDecoder::set_block_times(const BlockTimes& times_ns, std::int32_t lower_delay_ns) noexcept {
  block_times_ns_ = times_ns;
  const std::array<std::int32_t, kLasers> laser_ns = laser_times_ns(format_);
  for (std::size_t laser = 0; laser < kLasers; ++laser) {
    const std::int32_t block_ns = laser < kLasersPerBlock ? 0 : lower_delay_ns;
    table_.time_s[laser] = static_cast<float>(laser_ns[laser] + block_ns) * 1e-9F;
  }
}

void PacketDecoder::set_power_level(PowerLevel level) noexcept {
  distance_bits_ = level == PowerLevel::kRaw ? 0xFFF8 : 0xFFFF;
  corrects_intensity_ = has_focal_slopes_ && level != PowerLevel::kCorrected;
}

void PacketDecoder::decode(const PacketView& packet, const Rotation& rotation, PacketReturns& out) noexcept {
  aim(rotation.rate_rad_s);
  const PacketLayout& layout = format_.layout(packet);
  Direction head{std::cos(rotation.azimuth_rad), std::sin(rotation.azimuth_rad)};
  double turned_s = 0.0;
  for (std::size_t firing = 0; firing < static_cast<std::size_t>(layout.firings); ++firing) {
    const FiringBlocks& blocks = layout.blocks[firing];
    const double at_s = 1e-9 * block_times_ns_[static_cast<std::size_t>(blocks.upper)];
    head.turn(rotation.rate_rad_s * (at_s - turned_s));
    turned_s = at_s;
    const Heading heading{static_cast<float>(head.cosine), static_cast<float>(head.sine)};
    decode_firing(packet, blocks, heading, out.strongest[firing],
                  format_.is_dual() ? &out.others[firing] : nullptr);
  }
}

// rotCorrection, less the rotation until the laser fires (6 mrad at 20 Hz, 20 for an S1's lower block): by a
// series whose error is below 1e-8. It is the same for all firings of a packet.
void PacketDecoder::aim(double rate_rad_s) noexcept {
  const LaserTable& __restrict t = table_;
  const auto rate = static_cast<float>(rate_rad_s);
  for (std::size_t i = 0; i < kLasers; ++i) {
    const float turn = rate * t.time_s[i], turn_sq = turn * turn;
    const float cos_turn = 1.0F - 0.5F * turn_sq, sin_turn = turn - turn * turn_sq * (1.0F / 6.0F);
    cos_aside_[i] = t.cos_rotation[i] * cos_turn + t.sin_rotation[i] * sin_turn;
    sin_aside_[i] = t.sin_rotation[i] * cos_turn - t.cos_rotation[i] * sin_turn;
  }
}

void PacketDecoder::decode_firing(const PacketView& packet,
                                  const FiringBlocks& blocks,
                                  Heading heading,
                                  FiringReturns& strongest,
                                  FiringReturns* others) const noexcept {
  PacketLanes lanes;  // NOLINT(*-member-init): the steps below write every entry that later ones read
  lanes.unpack(packet, blocks.upper, blocks.lower, distance_bits_);
  if (others != nullptr) {
    PacketLanes seconds;  // NOLINT(*-member-init)
    seconds.unpack(packet, blocks.second_upper, blocks.second_lower, distance_bits_);
    sort_echoes(table_.first_raw, table_.last_raw, lanes, seconds, strongest.echo, others->echo);
    others->valid = fastest::in_range(seconds.raw, table_.first_raw, table_.last_raw);
    if (others->valid != 0) finish(seconds, heading, *others);
  }
  strongest.valid = fastest::in_range(lanes.raw, table_.first_raw, table_.last_raw);
  finish(lanes, heading, strongest);
}

void PacketDecoder::finish(const PacketLanes& lanes, Heading heading, FiringReturns& out) const noexcept {
  place(lanes.raw.data(), heading, out);
  store_intensity(lanes, out);
}

// The manual's formulas (x right, y forward), in single precision: sine and cosine of the head's azimuth are
// taken in double.
void PacketDecoder::place(const std::int32_t* __restrict raw,
                          Heading head,
                          FiringReturns& __restrict out) const noexcept {
  const LaserTable& __restrict t = table_;
  const float lsb_m = distance_lsb_m_;
  constexpr auto kFar = static_cast<float>(kFar_m);
  for (std::size_t i = 0; i < kLasers; ++i) {
    const float c = head.cosine * cos_aside_[i] + head.sine * sin_aside_[i];
    const float s = head.sine * cos_aside_[i] - head.cosine * sin_aside_[i];

    const float d = static_cast<float>(raw[i]) * lsb_m + t.distance_m[i];
    const float xy = d * t.cos_vertical[i] + t.xy_offset_m[i];
    const float hc = t.horizontal_offset_m[i] * c, hs = t.horizontal_offset_m[i] * s;
    const float near = raw[i] < t.first_far_raw[i] ? 1.0F : 0.0F;
    const float near_x = near * t.near_slope_x[i] * (kFar - std::abs(xy * s - hc));
    const float near_y = near * t.near_slope_y[i] * (kFar - std::abs(xy * c + hs));
    out.x_m[i] = (xy + near_y * t.cos_vertical[i]) * c + hs;
    out.y_m[i] = hc - (xy + near_x * t.cos_vertical[i]) * s;
    out.z_m[i] = (d + near_y) * t.sin_vertical[i] + t.z_offset_m[i];
  }
}

// I + slope * |256 (1 - focal distance / 131 m)^2 - 256 (1 - raw / 65535)^2|, within the laser's limits.
void PacketDecoder::store_intensity(const PacketLanes& __restrict lanes,
                                    FiringReturns& __restrict out) const noexcept {
  if (!corrects_intensity_) {
    for (std::size_t i = 0; i < kLasers; ++i)
      out.intensity[i] = static_cast<std::uint8_t>(lanes.intensity[i]);
    return;
  }
  const LaserTable& __restrict t = table_;
  for (std::size_t i = 0; i < kLasers; ++i) {
    const float away = 1.0F - static_cast<float>(lanes.raw[i]) * (1.0F / 65535.0F);
    const float added = t.focal_slope[i] * std::abs(t.focal_offset[i] - 256.0F * away * away);
    float value = static_cast<float>(lanes.intensity[i]) + added;
    value = value < t.min_intensity[i] ? t.min_intensity[i] : value;
    value = value > t.max_intensity[i] ? t.max_intensity[i] : value;
    // value >= 0; lround() would keep this loop from becoming vector code
    const auto rounded = static_cast<std::int32_t>(value + 0.5F);  // NOLINT(bugprone-incorrect-roundings)
    out.intensity[i] = static_cast<std::uint8_t>(rounded);
  }
}

}  // namespace pago::hdl64
