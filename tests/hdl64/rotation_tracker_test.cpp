// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/rotation_tracker.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::hdl64;

namespace {

using Turning = std::function<double(double)>;  // revolutions at a time in seconds
constexpr std::size_t kPrimed = 64;

double wrapped_deg(double revolutions) {
  return (revolutions - std::round(revolutions)) * 360.0;
}

/// What the encoder of a head that turns like this would put into the headers.
PacketAzimuths encode(const Turning& turning, std::int64_t packet) {
  PacketAzimuths result{.time_ns = packet * kPacketPeriod_ns};
  for (int firing = 0; firing < kFirings; ++firing) {
    const double t = static_cast<double>(result.time_ns + firing * kFiringPeriod_ns) * 1e-9;
    const auto steps = static_cast<std::int64_t>(std::floor(turning(t) / kEncoderStep_rev + 1e-9));
    result.azimuth_cdeg[static_cast<std::size_t>(firing)] =
        static_cast<std::uint16_t>(((steps % 4000 + 4000) % 4000) * 9);
  }
  return result;
}

std::vector<PacketAzimuths> encode_all(const Turning& turning, double seconds) {
  std::vector<PacketAzimuths> packets;
  const auto n = static_cast<std::int64_t>(seconds * 1e9) / kPacketPeriod_ns;
  for (std::int64_t i = 0; i < n; ++i) packets.push_back(encode(turning, i));
  return packets;
}

/// Largest error of the azimuth at any firing, degrees; the first packets prime.
double largest_error_deg(const std::vector<PacketAzimuths>& packets, const Turning& truth) {
  RotationTracker tracker;
  tracker.prime(std::span(packets).first(std::min(kPrimed, packets.size())), false);
  double worst = 0.0;
  for (const PacketAzimuths& packet : packets) {
    REQUIRE(tracker.add(packet));
    for (int firing = 0; firing < kFirings; ++firing) {
      const std::int64_t at_ns = packet.time_ns + firing * kFiringPeriod_ns;
      const double error = tracker.revolutions(at_ns) - truth(static_cast<double>(at_ns) * 1e-9);
      worst = std::max(worst, std::abs(wrapped_deg(error)));
    }
  }
  return worst;
}

/// The rotation behind a recording of constant speed: one least-squares line through all of its headers.
Turning global_fit(const std::vector<PacketAzimuths>& packets) {
  double n = 0, t1 = 0, t2 = 0, y = 0, ty = 0, turned = 0, last = 0;
  for (const PacketAzimuths& packet : packets) {
    for (int firing = 0; firing < kFirings; ++firing) {
      const double now = packet.azimuth_cdeg[static_cast<std::size_t>(firing)] / 36000.0;
      turned += n == 0 ? now : (now - last) - std::round(now - last);
      last = now;
      const double t =
          static_cast<double>(packet.time_ns - packets[0].time_ns + firing * kFiringPeriod_ns) * 1e-9;
      n += 1, t1 += t, t2 += t * t, y += turned, ty += t * turned;
    }
  }
  const double rate = (n * ty - t1 * y) / (n * t2 - t1 * t1);
  const double start = (y - rate * t1) / n, origin = static_cast<double>(packets[0].time_ns) * 1e-9;
  return [=](double t) { return start + rate * (t - origin); };
}

std::vector<PacketAzimuths> headers_of(const std::vector<test::CapturedPacket>& capture) {
  std::vector<PacketAzimuths> packets;
  for (const test::CapturedPacket& packet : capture) {
    const PacketView view(std::span(packet.payload).first<kPacketBytes>());
    packets.push_back(PacketAzimuths::of(view, std::int64_t{view.stamp_us()} * 1000));
  }
  return packets;
}

Turning steady(double rate_hz) {
  return [=](double t) { return 0.5 + rate_hz * t; };
}

}  // namespace

TEST_CASE("a fading line is the weighted least-squares line", "[hdl64][rotation_tracker]") {
  // Oracle: the closed formula over all observations, each weighted by its age.
  constexpr double kMemory_s = 0.01;
  FadingLine line(kMemory_s);
  line.start(0, 0.0, 0.0);
  double w = 0, wt = 0, wtt = 0, wy = 0, wty = 0;
  std::int64_t now_ns = 0;
  std::vector<std::pair<std::int64_t, double>> seen;
  for (int i = 0; i < 400; ++i) {
    now_ns += 200'000 + (i % 7) * 131'000;
    seen.emplace_back(now_ns, std::sin(0.05 * i) + 0.01 * i);
    line.advance(now_ns);
    LineMoments moments;
    moments.add(0.0, seen.back().second - line.at(now_ns));
    line.correct(moments);
  }
  for (const auto& [time_ns, y] : seen) {
    const double t = static_cast<double>(time_ns - now_ns) * 1e-9, weight = std::exp(t / kMemory_s);
    w += weight, wt += weight * t, wtt += weight * t * t, wy += weight * y, wty += weight * t * y;
  }
  const double determinant = w * wtt - wt * wt;
  CHECK(line.at(now_ns) == Approx((wtt * wy - wt * wty) / determinant).epsilon(1e-9));
  CHECK(line.rate_rev_s() == Approx((w * wty - wt * wy) / determinant).epsilon(1e-9));
}

TEST_CASE("on synth_S2 the azimuth is within 0.01 degrees of the true one from the first firing on",
          "[hdl64][rotation_tracker]") {
  PAGO_DATA_OR_SKIP(file, "packets/synthetic/synth_S2.pcap");
  const std::vector<PacketAzimuths> packets = headers_of(test::read_capture(file));
  REQUIRE(packets.size() == 8681);
  // Headers lag by half an encoder step in the mean; the tracker has undone that.
  const Turning headers = global_fit(packets);
  CHECK(largest_error_deg(packets, [&](double t) { return headers(t) + 0.045 / 360.0; }) < 0.01);
}

TEST_CASE("from 5 to 20 Hz the azimuth stays within 0.01 degrees", "[hdl64][rotation_tracker]") {
  for (const double rate_hz : {4.9, 5.0, 6.5, 8.3, 9.6517, 10.0, 10.3, 11.7, 13.0, 15.0, 17.1, 20.0, 20.5}) {
    INFO(rate_hz << " Hz");
    CHECK(largest_error_deg(encode_all(steady(rate_hz), 2.0), steady(rate_hz)) < 0.01);
  }
}

TEST_CASE("where every firing advances whole encoder steps the error is the encoder's own",
          "[hdl64][rotation_tracker]") {
  const double rate_hz = 2.0 * kEncoderStep_rev / 48e-6;
  CHECK(largest_error_deg(encode_all(steady(rate_hz), 1.0), steady(rate_hz)) < 0.046);
}

TEST_CASE("a rotation within the hour's last and first seconds is one line", "[hdl64][rotation_tracker]") {
  // Sensor times of this century: 1e18 ns must not cost precision.
  std::vector<PacketAzimuths> packets = encode_all(steady(10.0), 1.0);
  constexpr std::int64_t kEpoch_ns = 1'790'000'000'000'000'000;
  RotationTracker tracker;
  for (auto& packet : packets) packet.time_ns += kEpoch_ns;
  tracker.prime(std::span(packets).first(kPrimed), false);
  for (const auto& packet : packets) {
    tracker.add(packet);
    const double truth = 0.5 + 10.0 * static_cast<double>(packet.time_ns - kEpoch_ns) * 1e-9;
    REQUIRE(std::abs(wrapped_deg(tracker.revolutions(packet.time_ns) - truth)) < 0.01);
  }
}

TEST_CASE("speed-up from 600 to 1200 rpm in two seconds is followed", "[hdl64][rotation_tracker]") {
  const Turning ramp = [](double t) {
    const double s = std::clamp(t - 0.5, 0.0, 2.0);
    return 10.0 * t + 10.0 * (0.25 * s * s + std::max(0.0, t - 2.5));
  };
  CHECK(largest_error_deg(encode_all(ramp, 3.5), ramp) < 0.08);
}

TEST_CASE("a governor that hunts by 0.2 % every turn is followed", "[hdl64][rotation_tracker]") {
  const Turning hunting = [](double t) { return 10.0 * t + 0.002 / 6.283185 * std::sin(62.83185 * t); };
  CHECK(largest_error_deg(encode_all(hunting, 2.0), hunting) < 0.05);
}

TEST_CASE("single wrong azimuths are ignored and counted", "[hdl64][rotation_tracker]") {
  std::vector<PacketAzimuths> packets = encode_all(steady(10.0), 2.0);
  std::uint64_t damaged = 0;
  for (std::size_t i = 0; i < packets.size(); i += 5) {  // some of them within the priming block
    auto& azimuth = packets[i].azimuth_cdeg[i % kFirings];
    azimuth =
        static_cast<std::uint16_t>((azimuth + 60U + 977U * i % 35880U) % 36000U);  // by 0.6 to 359.4 degrees
    if (i >= kPrimed) ++damaged;
  }
  CHECK(largest_error_deg(packets, steady(10.0)) < 0.01);
  RotationTracker tracker;
  tracker.prime(std::span(packets).first(kPrimed), false);
  for (const auto& packet : packets) tracker.add(packet);
  CHECK(tracker.rejected() == damaged);
}

TEST_CASE("priming is not led astray by wrong packets, the first and the last included",
          "[hdl64][rotation_tracker]") {
  std::vector<PacketAzimuths> block = encode_all(steady(12.0), 0.0185);
  REQUIRE(block.size() == 64);
  for (const std::size_t i : {0U, 1U, 8U, 9U, 17U, 33U, 40U, 62U, 63U})
    for (auto& azimuth : std::span(block[i].azimuth_cdeg).first(kFirings))
      azimuth = static_cast<std::uint16_t>((azimuth * 7U + 9000U + 300U * i) % 36000U);
  RotationTracker tracker;
  tracker.prime(block, false);
  CHECK(tracker.rate_rev_s() == Approx(12.0).epsilon(1e-3));
  CHECK(std::abs(wrapped_deg(tracker.revolutions(0) - 0.5)) < 0.01);
}

TEST_CASE("priming takes packets in any order, and as few as one", "[hdl64][rotation_tracker]") {
  std::vector<PacketAzimuths> block = encode_all(steady(10.0), 0.02);
  std::swap(block[3], block[30]);
  std::swap(block.front(), block.back());
  RotationTracker tracker;
  tracker.prime(block, false);
  CHECK(std::abs(wrapped_deg(tracker.revolutions(0) - 0.5)) < 0.01);
  RotationTracker short_sighted;
  short_sighted.prime(std::span(block).first(1), false);
  CHECK(short_sighted.rate_rev_s() == Approx(10.0).epsilon(0.06));
}

TEST_CASE("lost packets do not change the speed", "[hdl64][rotation_tracker]") {
  std::vector<PacketAzimuths> packets;
  for (std::int64_t i = 0; i < 6000; ++i)
    if (i % 11 != 3 && i % 500 > 60) packets.push_back(encode(steady(10.0), i));
  CHECK(largest_error_deg(packets, steady(10.0)) < 0.012);
}

TEST_CASE("turns are counted, not wrapped", "[hdl64][rotation_tracker]") {
  const std::vector<PacketAzimuths> packets = encode_all(steady(10.0), 2.0);
  RotationTracker tracker;
  tracker.prime(std::span(packets).first(kPrimed), false);
  const double begin = tracker.revolutions(0);
  for (const auto& packet : packets) tracker.add(packet);
  CHECK(tracker.revolutions(2'000'000'000) - begin == Approx(20.0).margin(1e-3));
}

TEST_CASE("a head that is suddenly elsewhere is noticed, and priming again finds it",
          "[hdl64][rotation_tracker]") {
  const double leap_rev = GENERATE(0.37, -0.3, -0.06, 0.5);
  const std::vector<PacketAzimuths> before = encode_all(steady(10.0), 0.3);
  RotationTracker tracker;
  tracker.prime(std::span(before).first(kPrimed), false);
  for (const auto& packet : before) REQUIRE(tracker.add(packet));
  const double counted = tracker.revolutions(before.back().time_ns);

  const Turning after = [leap_rev](double t) { return 10.0 * t + 0.5 + leap_rev; };
  std::vector<PacketAzimuths> block;
  for (std::int64_t i = 0; i < 64; ++i)
    block.push_back(encode(after, static_cast<std::int64_t>(before.size()) + i));
  CHECK_FALSE(tracker.add(block[0]));
  CHECK(tracker.revolutions(before.back().time_ns) == counted);
  CHECK_FALSE(tracker.prime(block, true));
  for (const auto& packet : block) {
    REQUIRE(tracker.add(packet));
    const double error =
        tracker.revolutions(packet.time_ns) - after(static_cast<double>(packet.time_ns) * 1e-9);
    REQUIRE(std::abs(wrapped_deg(error)) < 0.01);
    REQUIRE(tracker.revolutions(packet.time_ns) > counted);
  }
}

TEST_CASE("a head that drifted during a short silence is not taken for another",
          "[hdl64][rotation_tracker]") {
  // 40 ms at 0.25 % less speed: 0.36 degrees behind, and soon believed.
  const Turning drifted = [](double t) { return 10.0 * t - 0.025 * std::clamp(t - 0.5, 0.0, 0.04); };
  RotationTracker tracker;
  const std::vector<PacketAzimuths> packets = encode_all(drifted, 1.0);
  tracker.prime(std::span(packets).first(kPrimed), false);
  for (const auto& packet : packets) {
    const double t = static_cast<double>(packet.time_ns) * 1e-9;
    if (t > 0.5 && t < 0.54) continue;
    REQUIRE(tracker.add(packet));
    const double error_deg = wrapped_deg(tracker.revolutions(packet.time_ns) - drifted(t));
    REQUIRE(std::abs(error_deg) < (t < 0.54 ? 0.01 : t < 0.55 ? 0.4 : 0.05));
  }
}

TEST_CASE("after a silence priming goes on counting turns by the clock", "[hdl64][rotation_tracker]") {
  RotationTracker tracker;
  const std::vector<PacketAzimuths> before = encode_all(steady(10.0), 0.3);
  tracker.prime(before, false);
  const double counted = tracker.revolutions(0);
  std::vector<PacketAzimuths> block;
  for (std::int64_t i = 5000; i < 5064; ++i) block.push_back(encode(steady(10.0), i));
  CHECK(tracker.prime(block, true));
  CHECK(tracker.revolutions(block[0].time_ns) - counted == Approx(10.0 * 5000 * 288e-6).margin(1e-3));
}

TEST_CASE("after a restart of the clock turns go on upwards", "[hdl64][rotation_tracker]") {
  RotationTracker tracker;
  const std::vector<PacketAzimuths> before = encode_all(steady(10.0), 1.0);
  tracker.prime(std::span(before).first(kPrimed), false);
  for (const auto& packet : before) tracker.add(packet);
  const double counted = tracker.revolutions(before.back().time_ns);
  CHECK_FALSE(tracker.prime(std::span(before).first(kPrimed), false));
  CHECK(tracker.revolutions(0) > counted);
  CHECK(tracker.revolutions(0) < counted + 1.5);
}

TEST_CASE("a head at rest, starting, and stopping is not taken for a rotation", "[hdl64][rotation_tracker]") {
  RotationTracker fresh;
  CHECK_FALSE(fresh.is_spinning());
  const Turning trip = [](double t) {  // rest, up to 10 Hz in 4 s, two seconds there, down again in 2 s, rest
    const double up = std::clamp(t - 1.0, 0.0, 4.0), at = std::clamp(t - 5.0, 0.0, 2.0),
                 down = std::clamp(t - 7.0, 0.0, 2.0);
    return 0.3 + 1.25 * up * up + 10.0 * at + (10.0 * down - 2.5 * down * down);
  };
  const std::vector<PacketAzimuths> packets = encode_all(trip, 10.0);
  RotationTracker tracker;
  tracker.prime(std::span(packets).first(kPrimed), false);
  for (const auto& packet : packets) {
    REQUIRE(tracker.add(packet));
    const double t = static_cast<double>(packet.time_ns) * 1e-9;
    if (t < 1.3 || t > 8.9) REQUIRE_FALSE(tracker.is_spinning());
    if (t > 1.5 && t < 8.7) REQUIRE(tracker.is_spinning());
  }
}

TEST_CASE("a head that turns backwards is not a rotation", "[hdl64][rotation_tracker]") {
  RotationTracker tracker;
  tracker.prime(encode_all(steady(-10.0), 0.02), false);
  CHECK(tracker.rate_rev_s() == Approx(-10.0).epsilon(1e-2));
  CHECK_FALSE(tracker.is_spinning());
}
