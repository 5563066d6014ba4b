// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/arrival_clock.hpp"

#include <random>

#include "pago/hdl64/block_times.hpp"
#include "support/catch.hpp"
#include "support/packet_stream.hpp"

using namespace pago;
using namespace pago::hdl64;

namespace {

/// A clock that reads the packets of a stream.
class Reader {
 public:
  explicit Reader(const test::StreamSettings& settings) : settings_(settings), stream_(settings) {
    clock_.set_format(settings.format, AzimuthTimes::of(settings.format, settings.format.block_times_ns()));
  }
  /// In packet periods after packet 0, by the clock; it must be a whole number.
  std::int64_t read(std::int64_t index, std::int64_t late_ns = 0) {
    const test::PacketBytes bytes = stream_.packet(index);
    const auto azimuths = PacketAzimuths::of(PacketView{bytes}, 0, settings_.format);
    const std::int64_t time_ns = clock_.read(azimuths, stream_.arrival_ns(index) + late_ns);
    if (!started_) origin_ns_ = time_ns - index * stream_.period_ns();
    started_ = true;
    REQUIRE((time_ns - origin_ns_) % stream_.period_ns() == 0);
    return (time_ns - origin_ns_) / stream_.period_ns();
  }
  std::int64_t origin_ns() const { return origin_ns_; }

 private:
  test::StreamSettings settings_;
  test::PacketStream stream_;
  ArrivalClock clock_;
  bool started_ = false;
  std::int64_t origin_ns_ = 0;
};

}  // namespace

TEST_CASE("packets are counted right from 5 to 20 Hz, whatever their delay", "[hdl64][arrival_clock]") {
  for (const StreamFormat& format : {test::early_s2(), test::s1()}) {
    for (const double rotation_hz : {5.0, 9.65, 10.0, 15.0, 20.0}) {
      INFO(name(format.kind) << " at " << rotation_hz << " Hz");
      Reader reader({.rotation_hz = rotation_hz, .format = format});
      std::mt19937 random(3);
      for (std::int64_t i = 0; i < 4000; ++i) {
        const auto late_ns = static_cast<std::int64_t>(random() % 20'000'000);
        REQUIRE(reader.read(i, late_ns) == i);
      }
    }
  }
}

TEST_CASE("time starts a packet before the first arrival", "[hdl64][arrival_clock]") {
  const test::StreamSettings settings{.format = test::early_s2()};
  Reader reader(settings);
  reader.read(0);
  CHECK(reader.origin_ns() == settings.arrival_ns - 288'000);
}

TEST_CASE("lost packets are counted by the way of the head, whole turns by arrival",
          "[hdl64][arrival_clock]") {
  for (const std::int64_t lost : {1, 7, 60, 180, 346, 347, 348, 1000, 3472}) {
    INFO(lost << " lost");
    Reader reader({.format = test::early_s2()});
    for (std::int64_t i = 0; i < 500; ++i) reader.read(i);
    // Jitter of 30 ms is less than half a turn.
    CHECK(reader.read(500 + lost, lost % 2 == 0 ? 30'000'000 : -30'000'000) == 500 + lost);
    CHECK(reader.read(501 + lost) == 501 + lost);
  }
}

TEST_CASE("a doubled packet has its own time again, an overtaken one an earlier time",
          "[hdl64][arrival_clock]") {
  Reader reader({.format = test::early_s2()});
  for (std::int64_t i = 0; i < 300; ++i) reader.read(i);
  CHECK(reader.read(299, 1000) == 299);
  CHECK(reader.read(301) == 301);
  CHECK(reader.read(300, 600'000) == 300);
  CHECK(reader.read(302) == 302);
}

TEST_CASE("a host's clock that is set back or on by hours costs no packet", "[hdl64][arrival_clock]") {
  // Forwards it looks like a silence, of which nothing is known but that the head's angle fits.
  Reader reader({.format = test::early_s2()});
  constexpr std::int64_t kHour_ns = 3'600'000'000'000;
  std::int64_t last = 0;
  for (std::int64_t i = 0; i < 500; ++i) last = reader.read(i);
  for (std::int64_t i = 500; i < 1000; ++i) {
    const std::int64_t now = reader.read(i, -kHour_ns);
    REQUIRE(now == last + 1);
    last = now;
  }
  const std::int64_t leapt = reader.read(1000, kHour_ns);
  CHECK(leapt > last);
  CHECK(reader.read(1001, kHour_ns) == leapt + 1);
}

TEST_CASE("at rest packets follow each other, and silences are measured", "[hdl64][arrival_clock]") {
  Reader reader({.rotation_hz = 0.0, .format = test::early_s2()});
  std::mt19937 random(4);
  for (std::int64_t i = 0; i < 500; ++i)
    REQUIRE(reader.read(i, static_cast<std::int64_t>(random() % 5'000'000)) == i);
  CHECK(reader.read(1500) == Approx(1500).margin(18));  // 5 ms
}

TEST_CASE("a head that speeds up is followed", "[hdl64][arrival_clock]") {
  test::StreamSettings settings{.format = test::s1()};
  settings.turned_deg = [](double t) { return 360.0 * (5.0 * t + 2.5 * t * t); };  // 5 to 15 Hz in 2 s
  Reader reader(settings);
  for (std::int64_t i = 0; i < 5200; ++i)
    if (i % 50 != 10) REQUIRE(reader.read(i, i % 7 * 300'000) == i);
}

TEST_CASE("an S1's uneven block times are measured from its azimuths", "[hdl64][block_times]") {
  // Upper blocks follow each other at 24.8 us, behind a lower one comes a pause (an estimate of real units).
  BlockTimes truth{};
  for (std::size_t block = 1; block < kBlocks; ++block)
    truth[block] = truth[block - 1] + (block % 4 == 0 ? 53'805 : 24'800);
  const StreamFormat format = test::s1();
  for (const double rotation_hz : {5.0, 10.0, 14.7}) {
    const test::PacketStream stream({.rotation_hz = rotation_hz, .format = format, .block_times_ns = truth});
    std::vector<PacketAzimuths> packets;
    for (std::int64_t i = 0; i < 64; ++i) {
      const test::PacketBytes bytes = stream.packet(i);
      packets.push_back(PacketAzimuths::of(PacketView{bytes}, i * format.packet_period_ns(), format));
    }
    const auto measured = measure_block_times(packets, format.packet_period_ns());
    REQUIRE(measured.has_value());
    for (std::size_t block = 0; block < kBlocks; ++block) {
      INFO(rotation_hz << " Hz, block " << block);
      CHECK(std::abs((*measured)[block] - truth[block]) < 4'000);
    }
    const test::PacketBytes bytes = stream.packet(0);
    CHECK(lower_delay_ns(format.layout(PacketView{bytes}), *measured) == Approx(24'800).margin(3'000));
  }
}

TEST_CASE("a head at rest tells no block times", "[hdl64][block_times]") {
  const StreamFormat format = test::s1();
  const std::vector<PacketAzimuths> packets(64);
  CHECK_FALSE(measure_block_times(packets, format.packet_period_ns()).has_value());
  CHECK_FALSE(measure_block_times({}, format.packet_period_ns()).has_value());
}
