// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "scan_collector.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "head.hpp"

namespace pago::simulator {
namespace {

constexpr double kTurn_rad = 2.0 * std::numbers::pi;

}  // namespace

ScanCollector::ScanCollector(const Simulator& drive, const Hdl64Config& sensor, bool is_compensated, Use use)
    : drive_(drive),
      format_(drive.format()),
      decoder_(drive.calibration(), sensor.min_range_m, sensor.max_range_m),
      is_compensated_(is_compensated),
      use_(std::move(use)) {
  decoder_.set_format(format_);
  begin(0);
}

void ScanCollector::begin(std::uint64_t scan) {
  scan_ = scan;
  T_mid_world_ = drive_.T_world_sensor(drive_.sweep(scan).mid_ns).inverse();
}

void ScanCollector::end() {
  for (std::vector<LabelledPoint>& ring : rings_)
    std::ranges::stable_sort(ring, {}, &LabelledPoint::turn_rad);
  use_(scan_, rings_);
  for (std::vector<LabelledPoint>& ring : rings_) ring.clear();
}

void ScanCollector::decode(const SimulatedPacket& packet) {
  const double turns = drive_.revolutions(packet.time_ns);
  const double later = drive_.revolutions(packet.time_ns + format_.packet_period_ns());
  decoder_.decode(hdl64::PacketView(packet.bytes),
                  {kTurn_rad * (turns - std::floor(turns)),
                   kTurn_rad * (later - turns) / (static_cast<double>(format_.packet_period_ns()) * 1e-9)},
                  returns_);
}

void ScanCollector::add(const SimulatedPacket& packet) {
  decode(packet);
  for (int firing = 0; firing < format_.firings(); ++firing) {
    const std::int64_t time_ns = packet.time_ns + firing * format_.firing_period_ns;
    const auto scan = static_cast<std::uint64_t>(drive_.revolutions(time_ns) - Head::kStart_rev);
    if (scan != scan_) {
      end();
      begin(scan);
    }
    add_firing(packet, firing);
  }
}

void ScanCollector::finish(std::uint64_t num_scans) {
  if (num_scans > scan_) end();
}

void ScanCollector::add_firing(const SimulatedPacket& packet, int firing) {
  const std::int64_t time_ns = packet.time_ns + firing * format_.firing_period_ns;
  const hdl64::FiringReturns& returns = returns_.strongest[static_cast<std::size_t>(firing)];
  const std::size_t blocks_per_firing = format_.is_dual() ? 4 : 2;
  // Within a firing the vehicle moves by a millimetre at most.
  const Eigen::Isometry3d T_mid_sensor =
      T_mid_world_ * drive_.T_world_sensor(time_ns + format_.firing_period_ns / 2);
  for (std::uint64_t left = returns.valid; left != 0; left &= left - 1) {
    const auto laser = static_cast<std::size_t>(std::countr_zero(left));
    Eigen::Vector3f p(returns.x_m[laser], returns.y_m[laser], returns.z_m[laser]);
    if (is_compensated_) p = (T_mid_sensor * p.cast<double>()).cast<float>();
    const std::size_t block =
        blocks_per_firing * static_cast<std::size_t>(firing) + laser / hdl64::kLasersPerBlock;
    const double turn_rad = std::atan2(double{p.y()}, double{p.x()});
    rings_[drive_.calibration().ring_of_laser[laser]].push_back(
        {p.x(), p.y(), p.z(), static_cast<float>(returns.intensity[laser]) / 255.0F,
         static_cast<float>(turn_rad < 0.0 ? turn_rad + kTurn_rad : turn_rad),
         packet.labels[block * hdl64::kLasersPerBlock + laser % hdl64::kLasersPerBlock]});
  }
}

}  // namespace pago::simulator
