// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/core/sources.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/stream_format.hpp"
#include "support/packet_builder.hpp"
#include "support/street.hpp"

namespace pago::test {

/// An ideal unit: rings evenly spaced from -24.8 to +2 degrees, lasers 0-31 the upper half; no offsets.
inline hdl64::Calibration ideal_calibration() {
  hdl64::Calibration calibration;
  for (int laser = 0; laser < 64; ++laser) {
    const int ring = laser < 32 ? 32 + laser : laser - 32;
    auto& figures = calibration.lasers[static_cast<std::size_t>(laser)];
    figures.vertical_rad = (-24.8 + 26.8 * ring / 63.0) * std::numbers::pi / 180.0;
    calibration.ring_of_laser[static_cast<std::size_t>(laser)] = static_cast<std::uint8_t>(ring);
  }
  return calibration;
}

/// A drive along the street as a sensor would send it: each ray at its own firing time and encoder angle,
/// ranges quantised to 2 mm. Starts at the cut angle behind the vehicle.
inline std::vector<PacketBytes> drive_packets(const Vector6d& twist, int sweeps, double rotation_hz = 10.0) {
  const Street street;
  const hdl64::Calibration calibration = ideal_calibration();
  const auto firings = static_cast<int>(std::ceil(sweeps / (rotation_hz * 48e-6))) + 1;
  std::vector<PacketBytes> packets;
  for (int first = 0; first + hdl64::kFirings <= firings + hdl64::kFirings; first += hdl64::kFirings) {
    PacketBuilder builder;
    builder.stamp_us(static_cast<std::uint32_t>(100'000'000 + first * 48)).status('H', 12);
    for (int k = 0; k < hdl64::kFirings; ++k) {
      const double fired_s = (first + k) * 48e-6;
      const double turned_deg = std::fmod(180.0 + 360.0 * rotation_hz * fired_s, 360.0);
      builder.azimuth_cdeg(k, static_cast<int>(std::floor(turned_deg / 0.09) * 9.0) % 36000);
      const Eigen::Isometry3d T_world_sensor = street_start() * exp_se3(twist * fired_s);
      for (int laser = 0; laser < hdl64::kLasers; ++laser) {
        const double late_s = hdl64::laser_time_ns(laser) * 1e-9;
        const double azimuth = (turned_deg + 360.0 * rotation_hz * late_s) * std::numbers::pi / 180.0;
        const double elevation = calibration.lasers[static_cast<std::size_t>(laser)].vertical_rad;
        const Eigen::Vector3d beam(std::cos(elevation) * std::cos(azimuth),
                                   -std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
        const auto range = street.cast(T_world_sensor.translation(), T_world_sensor.linear() * beam);
        if (range) builder.slot(k, laser, static_cast<int>(std::lround(*range / hdl64::kDistanceLsb_m)));
      }
    }
    packets.push_back(builder.bytes());
  }
  return packets;
}

/// Packets from memory, in batches of a chosen size.
class MemorySource final : public PacketSource {
 public:
  explicit MemorySource(const std::vector<PacketBytes>& packets, std::size_t batch = 64)
      : packets_(packets), batch_(batch), datagrams_(batch) {}

  std::span<const Datagram> receive() noexcept override {
    const std::size_t n = std::min(batch_, packets_.size() - next_);
    for (std::size_t i = 0; i < n; ++i) {
      datagrams_[i].payload = packets_[next_ + i];
      datagrams_[i].arrival_ns = 1'700'000'100'000'000'000 + static_cast<std::int64_t>(next_ + i) * 288'000;
    }
    next_ += n;
    counters_.received += n;
    counters_.delivered += n;
    return {datagrams_.data(), n};
  }
  bool all_done() const noexcept override { return next_ == packets_.size(); }
  SourceCounters counters() const noexcept override { return counters_; }
  Progress progress() const noexcept override {
    return {static_cast<double>(next_), static_cast<double>(packets_.size())};
  }
  std::string complaint() const override { return {}; }

 private:
  const std::vector<PacketBytes>& packets_;
  std::size_t batch_, next_ = 0;
  std::vector<Datagram> datagrams_;
  SourceCounters counters_;
};

/// Five sweeps at 8 m/s into a bend.
inline const std::vector<PacketBytes>& street_drive() {
  static const std::vector<PacketBytes> packets = [] {
    Vector6d twist = Vector6d::Zero();
    twist[0] = 8.0, twist[5] = 0.1;
    return drive_packets(twist, 5);
  }();
  return packets;
}

}  // namespace pago::test
