// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "assembly/collector.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "support/packet_stream.hpp"

namespace pago::test {

inline hdl64::Calibration plain_calibration() {
  hdl64::Calibration calibration;
  for (std::uint8_t laser = 0; laser < hdl64::kLasers; ++laser) calibration.ring_of_laser[laser] = laser;
  return calibration;
}

struct IngestRig {
  explicit IngestRig(const AssemblyConfig& config = {},
                     std::size_t ring = 3,
                     const hdl64::Calibration& calibration = plain_calibration())
      : collector(ring), ingest(config, {}, calibration, collector) {}

  void push(const PacketBytes& bytes, std::int64_t arrival_ns) {
    buffer = bytes;
    ingest.push({.payload = buffer, .arrival_ns = arrival_ns});
    buffer.fill(0xAA);  // as a receive buffer would be used again
    check_identities();
  }
  void push(const PacketStream& stream, int begin, int end) {
    for (int i = begin; i < end; ++i) push(stream.packet(i), stream.arrival_ns(i));
  }
  void finish() {
    ingest.finish();
    check_identities();
  }
  void check_identities() const {
    REQUIRE_EACH(ingest.packets().balanced());
    REQUIRE_EACH(ingest.firings().balanced());
    REQUIRE_EACH(ingest.sweeps().balanced());
  }
  const SweepHeader& header(std::size_t sweep) const { return collector.sweeps.at(sweep).header; }
  std::uint64_t bad(PacketFault fault) const { return ingest.packets().bad[static_cast<std::size_t>(fault)]; }

  Collector collector;
  PacketIngest ingest;
  PacketBytes buffer{};
};

/// The largest angle between a return and where the head of the stream truly pointed, degrees. Packet 0 of
/// the stream is at `origin_ns`; lasers have no offsets, so a return lies where the head points.
inline double largest_error_deg(const Sweep& sweep, const StreamSettings& settings, std::int64_t origin_ns) {
  double worst = 0.0;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const double t = static_cast<double>(sweep.header.start_ns + sweep.time_offset_ns[i] - origin_ns) * 1e-9;
    const double truth_deg = settings.azimuth_deg + 360.0 * settings.rotation_hz * t;
    const double x_m = sweep.x_m[i], y_m = sweep.y_m[i];
    const double seen_deg = std::atan2(-y_m, x_m) * 180.0 / std::numbers::pi;
    worst = std::max(worst, std::abs(std::remainder(seen_deg - truth_deg, 360.0)));
  }
  return worst;
}

}  // namespace pago::test
