// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/blind_sector.hpp"

#include <cmath>

#include "assembly/ingest_rig.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::test;

namespace {

/// A sensor that sends packets only while the head looks within `half_deg` of straight ahead.
struct LimitedView {
  StreamSettings settings{};
  double half_deg = 45.0;
  PacketStream stream{settings};

  bool is_sent(std::int64_t index) const {
    const double azimuth_deg = stream.true_azimuth_deg(index * stream.period_ns());
    return std::abs(std::remainder(azimuth_deg, 360.0)) < half_deg;
  }
  std::int64_t first_sent() const {
    std::int64_t i = 0;
    while (!is_sent(i)) ++i;
    return i;
  }
  /// Pushes what is sent of packets [begin, end); returns how many that was.
  std::uint64_t push(IngestRig& rig, int begin, int end) const {
    std::uint64_t sent = 0;
    for (int i = begin; i < end; ++i) {
      if (!is_sent(i)) continue;
      rig.push(stream, i, i + 1);
      ++sent;
    }
    return sent;
  }
};

}  // namespace

TEST_CASE("gaps at the same angles are no losses from the third on", "[assembly][blind_sector]") {
  BlindSector sector;
  for (int turn = 0; turn < 2; ++turn) CHECK(sector.note_gap(turn + 0.125, turn + 0.875, 1562) == 0);
  CHECK_FALSE(sector.is_known());
  CHECK(sector.note_gap(2.126, 2.874, 1560) == 2 * 1562 + 1560);
  CHECK(sector.is_known());
  CHECK(sector.note_gap(3.124, 3.876, 1566) == 1566);
}

TEST_CASE("a loss beside the blind sector is told apart from it", "[assembly][blind_sector]") {
  BlindSector sector;
  for (int turn = 0; turn < 3; ++turn) sector.note_gap(turn + 0.125, turn + 0.875, 1562);
  CHECK(sector.note_gap(3.0, 3.875, 1822) == Approx(1562).margin(2));  // lost before it
  CHECK(sector.note_gap(4.125, 5.0, 1822) == Approx(1562).margin(2));  // and after it
  CHECK(sector.is_known());
  CHECK(sector.note_gap(6.125, 6.875, 1562) == 1562);
  CHECK(sector.note_gap(6.95, 7.05, 208) == 0);                              // elsewhere
  CHECK(sector.note_gap(7.125, 8.875, 3645) == Approx(2 * 1562).margin(4));  // a whole turn in between
}

TEST_CASE("gaps that come and go are losses", "[assembly][blind_sector]") {
  BlindSector sector;
  for (int i = 0; i < 50; ++i) CHECK(sector.note_gap(1.37 * i, 1.37 * i + 0.1, 208) == 0);
  CHECK_FALSE(sector.is_known());
  for (int turn = 0; turn < 50; ++turn) CHECK(sector.note_gap(turn, turn + 0.01, 20) == 0);  // too small
}

TEST_CASE("a packet out of the blind sector ends it", "[assembly][blind_sector]") {
  BlindSector sector;
  for (int turn = 0; turn < 3; ++turn) sector.note_gap(turn + 0.125, turn + 0.875, 1562);
  sector.note_packet(0.12);
  sector.note_packet(0.88);
  CHECK(sector.is_known());
  sector.note_packet(0.5);
  CHECK_FALSE(sector.is_known());
}

TEST_CASE("a limited field of view is found out, loses nothing, and gives a sweep per turn",
          "[assembly][blind_sector]") {
  for (const double half_deg : {20.0, 45.0, 90.0, 150.0}) {
    for (const double cut_deg : {180.0, 0.0}) {
      INFO(2 * half_deg << " degrees in view, cut at " << cut_deg);
      const LimitedView view{.half_deg = half_deg};
      AssemblyConfig config;
      config.cut_azimuth_deg = cut_deg;
      IngestRig rig(config);
      double worst_deg = 0.0;
      std::int64_t packet_0_ns = 0;
      rig.collector.on_part = [&](const SweepPart& part) {
        const SweepHeader& h = part.sweep->header;
        if (packet_0_ns == 0) packet_0_ns = h.start_ns - view.first_sent() * view.stream.period_ns();
        if (h.sequence >= 5)
          worst_deg = std::max(worst_deg, largest_error_deg(*part.sweep, view.settings, packet_0_ns));
      };
      const std::uint64_t sent = view.push(rig, 0, 7000);
      rig.finish();
      CHECK(rig.ingest.is_view_limited());
      CHECK(rig.ingest.packets().decoded == sent);
      CHECK(rig.ingest.firings().lost == 0);
      CHECK(rig.ingest.firings().decoded == 6 * sent);
      CHECK(rig.ingest.firings().blind == rig.ingest.firings().expected - 6 * sent);
      CHECK(worst_deg < 0.05);
      REQUIRE(rig.collector.sweeps.size() >= 18);
      for (std::size_t i = 6; i + 2 < rig.collector.sweeps.size(); ++i) {
        const SweepHeader& h = rig.header(i);
        REQUIRE(h.sequence == rig.header(i - 1).sequence + 1);
        REQUIRE(h.flags == 0);
        REQUIRE(h.firings_lost == 0);
        REQUIRE(h.firings_received == Approx(2083.3 * half_deg / 180.0).margin(13));
        REQUIRE(h.firings_blind == Approx(2083.3 * (1.0 - half_deg / 180.0)).margin(13));
      }
    }
  }
}

TEST_CASE("a sweep of a limited view ends with the view, not with the next turn",
          "[assembly][blind_sector]") {
  const LimitedView view{.half_deg = 45.0};
  IngestRig rig;
  std::vector<std::int64_t> waits_ns;
  std::int64_t now_ns = 0;
  rig.collector.on_part = [&](const SweepPart& part) {
    if (part.sweep->header.sequence > 6) waits_ns.push_back(now_ns - part.sweep->header.last_arrival_ns);
  };
  for (int i = 0; i < 7000; ++i) {
    now_ns = view.stream.arrival_ns(i);
    if (view.is_sent(i)) rig.push(view.stream, i, i + 1);
  }
  REQUIRE(waits_ns.size() > 10);
  const auto at_once = std::count(waits_ns.begin(), waits_ns.end(), 0);
  CHECK(at_once >= static_cast<std::ptrdiff_t>(waits_ns.size() * 6 / 10));
}

TEST_CASE("losses within a limited view are counted to the packet", "[assembly][blind_sector]") {
  const LimitedView view;
  IngestRig rig;
  view.push(rig, 0, 3000);
  CHECK(rig.ingest.firings().lost == 0);
  std::uint64_t lost = 0;
  for (int i = 3000; i < 8000; ++i) {
    if (!view.is_sent(i)) continue;
    const bool is_well_inside = view.is_sent(i - 12) && view.is_sent(i + 12);
    if (is_well_inside && i % 9 == 0)
      ++lost;
    else
      rig.push(view.stream, i, i + 1);
  }
  CHECK(rig.ingest.firings().lost == 6 * lost);
  CHECK(rig.ingest.is_view_limited());
}

TEST_CASE("a view that is opened again is seen in the same turn", "[assembly][blind_sector]") {
  const LimitedView view;
  IngestRig rig;
  view.push(rig, 0, 3000);
  CHECK(rig.ingest.is_view_limited());
  rig.push(view.stream, 3000, 6000);
  CHECK_FALSE(rig.ingest.is_view_limited());
  const std::size_t n = rig.collector.sweeps.size();
  for (std::size_t i = n - 5; i < n; ++i) CHECK(rig.header(i).flags == 0);
}
