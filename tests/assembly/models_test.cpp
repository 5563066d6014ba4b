// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Streams of every model through the ingest, found out and decoded without any setting.
#include <algorithm>
#include <cmath>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

namespace {

/// The largest error of a return's direction over a whole stream, from which sweep 0 starts with packet 0.
struct Worst {
  Worst(IngestRig& rig, const StreamSettings& settings) {
    rig.collector.on_part = [this, settings](const SweepPart& part) {
      if (origin_ns == 0) origin_ns = part.sweep->header.start_ns;
      error_deg = std::max(error_deg, largest_error_deg(*part.sweep, settings, origin_ns));
    };
  }
  std::int64_t origin_ns = 0;
  double error_deg = 0.0;
};

/// Three revolutions and a bit.
int packets_of(const StreamSettings& settings) {
  return static_cast<int>(3.2e9 / settings.rotation_hz) /
         static_cast<int>(settings.format.packet_period_ns());
}

}  // namespace

TEST_CASE("every model is found out, and none of its packets lost", "[assembly][models]") {
  for (const hdl64::StreamFormat& format :
       {single_return(), single_return_s3(), dual_return(), early_s2(), s1()}) {
    for (const double rotation_hz : {5.5, 10.0, 15.0}) {
      const StreamSettings settings{.rotation_hz = rotation_hz, .azimuth_deg = 181.0, .format = format};
      INFO(hdl64::name(format.kind) << ", " << format.firing_period_ns << " ns, " << rotation_hz << " Hz");
      IngestRig rig;
      const Worst worst(rig, settings);
      const int packets = packets_of(settings);
      rig.push(PacketStream(settings), 0, packets);
      rig.finish();
      CHECK(rig.ingest.format() == format);
      CHECK(rig.ingest.packets().decoded == static_cast<std::uint64_t>(packets));
      const auto firings = static_cast<std::uint64_t>(packets * format.firings());
      CHECK(rig.ingest.firings().expected == firings);
      CHECK(rig.ingest.firings().lost == 0);
      CHECK(rig.collector.received() == firings);
      CHECK(rig.ingest.rotation_hz() == Approx(rotation_hz).epsilon(1e-3));
      REQUIRE(rig.collector.sweeps.size() == 4);
      for (std::size_t i = 0; i < 3; ++i) {
        CHECK(rig.header(i).flags == 0);
        CHECK(rig.header(i).firings_lost == 0);
        const double columns = 1e9 / rotation_hz / static_cast<double>(format.firing_period_ns);
        if (i > 0) CHECK(rig.header(i).num_columns == Approx(columns).margin(1.01));
      }
      CHECK(worst.error_deg < (format.kind == hdl64::SensorKind::kHdl64S1 ? 0.12 : 0.0115));
    }
  }
}

TEST_CASE("equal returns of dual mode are one, and fill the range image as single mode does",
          "[assembly][models]") {
  const StreamSettings settings{.format = dual_return()};
  IngestRig rig;
  rig.push(PacketStream(settings), 0, packets_of(settings));
  REQUIRE(rig.collector.sweeps.size() == 3);
  for (std::size_t i = 0; i < 3; ++i)
    CHECK(rig.collector.sweeps[i].size == 64 * rig.header(i).firings_received);
}

TEST_CASE("the weaker of two returns is kept beside the image, with the stronger one's ring and column",
          "[assembly][models]") {
  const StreamSettings settings{.raw = 3000, .format = dual_return(), .second_raw = 5000};
  IngestRig rig;
  int checked = 0;
  rig.collector.allows_echoes = true;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    REQUIRE(sweep.size == 128 * sweep.header.firings_received);
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const std::uint32_t firing = i / 128;
      const bool is_other = i % 128 >= 64;
      const float range_m = std::hypot(sweep.x_m[i], sweep.y_m[i]);
      REQUIRE_EACH(range_m == Approx(is_other ? 10.0 : 6.0));
      REQUIRE_EACH(sweep.intensity[i] == (is_other ? 50 : 100));
      REQUIRE_EACH(sweep.echo[i] == (is_other ? kNotStrongest : kNotLast));
      REQUIRE(sweep.ring[i] == i % 64);
      REQUIRE(sweep.column[i] == firing);
      const std::int32_t cell = sweep.range_image.at(sweep.ring[i], sweep.column[i]);
      REQUIRE(cell == static_cast<std::int32_t>(firing * 128 + i % 64));
      ++checked;
    }
  };
  rig.push(PacketStream(settings), 0, packets_of(settings));
  CHECK(checked > 3 * 128 * 1700);
}

TEST_CASE("a slow head in dual-return mode needs 460,800 returns and no more", "[assembly][models]") {
  const StreamSettings settings{.rotation_hz = 5.0, .raw = 3000, .format = dual_return(), .second_raw = 5000};
  for (const std::uint32_t max_returns : {460'800U, 278'528U}) {
    Collector collector(3, max_returns);
    collector.allows_echoes = true;
    PacketIngest ingest({}, {}, plain_calibration(), collector);
    const PacketStream stream(settings);
    for (int i = 0; i < packets_of(settings); ++i) {
      const PacketBytes bytes = stream.packet(i);
      ingest.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
    }
    ingest.finish();
    REQUIRE(collector.sweeps.size() >= 3);
    CHECK(collector.sweeps[1].header.has(kOverfull) == (max_returns < 460'800));
    if (max_returns == 460'800) CHECK(collector.sweeps[1].size == Approx(444'444).margin(256));
  }
}

TEST_CASE("an S1's lower rings have a return in every third column", "[assembly][models]") {
  const StreamSettings settings{.format = s1()};
  IngestRig rig;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    for (const int ring : {0, 31, 32, 63}) {
      int filled = 0;
      for (int column = 0; column < static_cast<int>(sweep.header.num_columns); ++column)
        filled += sweep.range_image.at(ring, column) != RangeImage::kEmpty ? 1 : 0;
      const double share = filled / static_cast<double>(sweep.header.num_columns);
      CHECK(share == Approx(ring < 32 ? 1.0 : 1.0 / 3.0).margin(0.001));
    }
  };
  rig.push(PacketStream(settings), 0, packets_of(settings));
  CHECK(rig.collector.sweeps.size() == 3);
}

TEST_CASE("an S1's uneven firing times are found from its azimuths", "[assembly][models]") {
  StreamSettings settings{.azimuth_deg = 181.0, .format = s1()};
  for (std::size_t block = 1; block < hdl64::kBlocks; ++block)
    settings.block_times_ns[block] = settings.block_times_ns[block - 1] + (block % 4 == 0 ? 53'805 : 24'800);
  const PacketStream stream(settings);
  IngestRig rig;
  double worst_deg = 0.0;
  std::int64_t origin_ns = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    const Sweep& sweep = *part.sweep;
    if (origin_ns == 0) origin_ns = sweep.header.start_ns;
    // Upper lasers, in order of firing: which packet and which block each return is from.
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const auto at_ns = sweep.header.start_ns + sweep.time_offset_ns[i] - origin_ns;
      const std::int64_t firing = (at_ns + 20'000) / settings.format.firing_period_ns;
      const std::int64_t in_packet = firing % 9, packet = firing / 9;
      const auto block =
          static_cast<std::size_t>(in_packet / 3 * 4 + in_packet % 3 + (sweep.ring[i] < 32 ? 0 : 1));
      const std::int64_t fired_ns =
          packet * settings.format.packet_period_ns() + settings.block_times_ns[block];
      const double seen_deg =
          std::atan2(-double{sweep.y_m[i]}, double{sweep.x_m[i]}) * 180.0 / std::numbers::pi;
      const double error = std::remainder(seen_deg - stream.true_azimuth_deg(fired_ns), 360.0);
      worst_deg = std::max(worst_deg, std::abs(error));
    }
  };
  rig.push(stream, 0, packets_of(settings));
  CHECK(rig.collector.sweeps.size() == 3);
  CHECK(worst_deg < 0.02);
}
