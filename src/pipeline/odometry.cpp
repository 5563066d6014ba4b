// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/odometry.hpp"

#include <algorithm>
#include <cmath>

#include "pago/assembly/scan_organizer.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/features/features.hpp"
#include "pago/ground/ground_stage.hpp"
#include "pago/mapping/mapper.hpp"
#include "pago/odometry/odometry.hpp"

namespace pago {
namespace {

constexpr float kMostTime_s = 2.0F;  // fits the sweep's 32 bits of nanoseconds

bool fits(std::size_t size, const Scan& scan) noexcept {
  return size == 0 || size == scan.points_m.size();
}

/// What is wrong with a scan by itself; empty if nothing.
std::string_view find_fault(const Scan& scan, std::size_t max_points) noexcept {
  constexpr std::int64_t kMostStamp_ns = std::int64_t{1} << 62, kMostDuration_ns = 1'000'000'000;
  const auto is_time = [](float time_s) { return std::abs(time_s) <= kMostTime_s; };  // false for NaN
  const auto is_ring = [](std::uint8_t ring) { return ring < kNumRings; };
  if (scan.points_m.size() > max_points) return "more points than assembly.max_returns";
  if (!fits(scan.times_s.size(), scan)) return "times_s and points_m differ in length";
  if (!fits(scan.rings.size(), scan)) return "rings and points_m differ in length";
  if (!std::ranges::all_of(scan.times_s, is_time)) return "a time is not within -2 to 2 s after the stamp";
  if (!std::ranges::all_of(scan.rings, is_ring)) return "a ring is above 63";
  if (scan.duration_ns < 0 || scan.duration_ns > kMostDuration_ns)
    return "duration_ns is not within 0 to 1 s";
  if (scan.stamp_ns < -kMostStamp_ns || scan.stamp_ns > kMostStamp_ns) return "stamp_ns is absurd";
  return {};
}

SweepHeader header_of(const Scan& scan, std::uint64_t sequence) noexcept {
  SweepHeader header;
  header.sequence = sequence;
  header.start_ns = header.first_arrival_ns = scan.stamp_ns;
  header.end_ns = header.last_arrival_ns = scan.stamp_ns + scan.duration_ns;
  header.num_columns = header.firings_received = static_cast<std::uint32_t>(scan_columns(scan.duration_ns));
  header.rotation_rev = 1.0F;
  header.flags = scan.times_s.empty() ? kCompensated : 0U;
  return header;
}

void copy_points(const Scan& scan, Sweep& sweep) noexcept {
  sweep.size = static_cast<std::uint32_t>(scan.points_m.size());
  for (std::size_t i = 0; i < scan.points_m.size(); ++i) {
    sweep.x_m[i] = scan.points_m[i].x();
    sweep.y_m[i] = scan.points_m[i].y();
    sweep.z_m[i] = scan.points_m[i].z();
  }
  std::ranges::copy(scan.rings, sweep.ring.begin());
  std::fill_n(sweep.time_offset_ns.begin(), sweep.size, 0);
  std::ranges::transform(scan.times_s, sweep.time_offset_ns.begin(), [](float time_s) {
    return static_cast<std::int32_t>(std::lround(static_cast<double>(time_s) * 1e9));
  });
}

}  // namespace

struct Odometry::Parts {
  Parts(const Config& c, std::uint32_t max_returns)
      : sweep(max_returns),
        organizer(max_returns, SelfFilter(c.vehicle, c.mount)),
        segmenter(c.ground, c.mount, max_returns),
        extractor(c.features, max_returns),
        mapper(c.mapping),
        odometer(c.odometry, max_returns, mapper.refined()) {}

  void run_stages() noexcept {
    Update next_targets(odometer);
    Update next_map(mapper);
    Chain stages(segmenter, extractor, odometer, mapper, next_targets, next_map);
    stages.process(sweep);
  }

  Sweep sweep;
  ScanOrganizer organizer;
  ground::GroundStage segmenter;
  features::FeaturesStage extractor;
  mapping::Mapper mapper;
  odometry::OdometryStage odometer;

  std::uint64_t sequence = 0;  // of the next scan
  std::string_view refusal;
};

Odometry::Odometry(const Config& config) {
  validate(config);
  if (ground::find_method(config.ground.method).traits.needs_labels)
    throw Error("ground.method", "'" + config.ground.method + "' needs labels, and scans have none",
                "choose another method");
  parts_ = std::make_unique<Parts>(config, max_returns_of(config.assembly, /*can_be_dual=*/false));
}
Odometry::~Odometry() = default;
Odometry::Odometry(Odometry&&) noexcept = default;
Odometry& Odometry::operator=(Odometry&&) noexcept = default;

Estimate Odometry::process(const Scan& scan) noexcept {
  Parts& p = *parts_;
  p.sweep.reset();
  p.refusal = find_fault(scan, max_points());
  if (!p.refusal.empty()) {
    Estimate nothing;
    nothing.stamp_ns = scan.stamp_ns;
    nothing.health = Health::kLost;
    nothing.reason = HealthReason::kRefusedScan;
    return nothing;
  }
  p.sweep.header = header_of(scan, p.sequence++);
  copy_points(scan, p.sweep);
  if (scan.rings.empty()) {
    p.organizer.organize(p.sweep);
  } else {
    p.organizer.place_columns(p.sweep);
  }
  p.run_stages();
  return p.sweep.estimate;
}

std::span<const std::uint8_t> Odometry::ground() const noexcept {
  return parts_->sweep.ground.first(parts_->sweep.size);
}
const ground::MountReport& Odometry::mount_report() const noexcept {
  return parts_->segmenter.mount_report();
}
std::string_view Odometry::refusal() const noexcept {
  return parts_->refusal;
}
std::size_t Odometry::max_points() const noexcept {
  return parts_->sweep.capacity();
}
std::uint64_t Odometry::scans_with_guessed_rings() const noexcept {
  return parts_->organizer.scans_with_guessed_rings();
}
std::uint64_t Odometry::points_left_out() const noexcept {
  return parts_->organizer.returns_without_cell();
}

}  // namespace pago
