// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/device_clock.hpp"

#include <algorithm>
#include <cmath>

#include "pago/hdl64/packet.hpp"
#include "support/catch.hpp"

using namespace pago::hdl64;
using Verdict = DeviceClock::Verdict;

namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000, kHour_ns = 3600 * kSecond_ns;
constexpr std::int64_t kNoon = 1'790'000'000 / 3600 * kHour_ns;  // a full hour since the epoch

std::uint32_t us(double seconds) {
  return static_cast<std::uint32_t>(std::llround(seconds * 1e6));
}
std::int64_t ns(double seconds) {
  return std::llround(seconds * 1e9);
}

}  // namespace

TEST_CASE("the first stamp takes the hour nearest to its arrival", "[hdl64][device_clock]") {
  struct Case {
    double stamp_s;
    std::int64_t arrival_ns, expected_ns;
  };
  const Case cases[] = {
      {10.0, kNoon + 10 * kSecond_ns + 300'000, kNoon + 10 * kSecond_ns},
      {3599.999999, kNoon + 1'000, kNoon - 1'000},  // sent just before, came just after
      {0.000001, kNoon - 1'000, kNoon + 1'000},     // the host's clock is a little slow
      {1700.0, kNoon, kNoon + 1700 * kSecond_ns},   // no GPS: any phase, at most 30 min
      {1900.0, kNoon, kNoon - 1700 * kSecond_ns},
      {4000.0, kNoon + 4000 * kSecond_ns, kNoon + 4000 * kSecond_ns},  // free-running past the hour
      {12.5, 30 * kSecond_ns, ns(12.5)},                               // the epoch itself
  };
  for (const Case& c : cases) {
    INFO(c.stamp_s);
    DeviceClock clock;
    const auto reading = clock.read(us(c.stamp_s), c.arrival_ns);
    CHECK(reading.verdict == Verdict::kRestarted);
    CHECK(reading.time_ns == c.expected_ns);
    CHECK(std::abs(reading.time_ns - c.arrival_ns) <= kHour_ns / 2);
  }
  CHECK(DeviceClock().restarts() == 0);
}

TEST_CASE("time runs on across the top of the hour", "[hdl64][device_clock]") {
  DeviceClock clock;
  std::int64_t last = 0;
  for (std::int64_t i = 0; i < 4000; ++i) {
    const std::int64_t since_hour_us = 3'599'500'000 + i * 288;
    const auto reading = clock.read(static_cast<std::uint32_t>(since_hour_us % kStampWrap_us),
                                    kNoon + since_hour_us * 1000 + 400'000);
    REQUIRE(reading.verdict == (i == 0 ? Verdict::kRestarted : Verdict::kFits));
    REQUIRE(reading.time_ns == kNoon + since_hour_us * 1000);
    REQUIRE(reading.time_ns > last);
    last = reading.time_ns;
  }
}

TEST_CASE("3599.9 s and then 0.1 s is a fifth of a second", "[hdl64][device_clock]") {
  DeviceClock clock;
  const auto before = clock.read(us(3599.9), kNoon + ns(3599.9));
  const auto after = clock.read(us(0.1), kNoon + ns(3600.1));
  CHECK(after.verdict == Verdict::kFits);
  CHECK(after.time_ns - before.time_ns == ns(0.2));
}

TEST_CASE("packets that overtook each other at the top of the hour keep their times",
          "[hdl64][device_clock]") {
  DeviceClock clock;
  const auto a = clock.read(3'599'999'700, kNoon);
  const auto c = clock.read(276, kNoon + 1000);
  const auto b = clock.read(3'599'999'988, kNoon + 2000);
  CHECK(b.verdict == Verdict::kFits);
  CHECK(b.time_ns - a.time_ns == 288'000);
  CHECK(c.time_ns - b.time_ns == 288'000);
}

TEST_CASE("a silence over the hour is measured", "[hdl64][device_clock]") {
  for (const double silence_s : {0.7, 20.0, 700.0, 3000.0, 3601.0, 9000.0}) {
    INFO(silence_s);
    DeviceClock clock;
    const auto before = clock.read(us(3500.0), kNoon + ns(3500.0));
    const double stamp_s = std::fmod(3500.0 + silence_s, 3600.0);
    // The host's clock drifts by 0.1 % and the arrival jitters by 50 ms.
    const auto after = clock.read(us(stamp_s), kNoon + ns(3500.0 + silence_s * 1.001 + 0.05));
    CHECK(after.verdict == Verdict::kFits);
    CHECK(after.time_ns - before.time_ns == ns(silence_s));
  }
}

TEST_CASE("a unit without GPS may count past the hour and to the end of its counter",
          "[hdl64][device_clock]") {
  DeviceClock clock;
  std::int64_t last = clock.read(us(3599.9), kNoon).time_ns;
  for (int i = 1; i < 8000; ++i) {
    const double elapsed_s = 0.1 * i;
    const auto stamp = static_cast<std::uint32_t>(std::llround((3599.9 + elapsed_s) * 1e6));  // wraps at 2^32
    const auto reading = clock.read(stamp, kNoon + ns(elapsed_s));
    REQUIRE(reading.verdict == Verdict::kFits);
    REQUIRE(reading.time_ns - last == 100'000'000);
    last = reading.time_ns;
  }
}

TEST_CASE("steps of the host's clock do not reach sensor time", "[hdl64][device_clock]") {
  for (const std::int64_t step : {-7200 * kSecond_ns, -5 * kSecond_ns, 5 * kSecond_ns, 86'400 * kSecond_ns}) {
    DeviceClock clock;
    const std::int64_t first = clock.read(us(100.0), kNoon).time_ns;
    for (int i = 1; i < 100; ++i) {
      const auto reading =
          clock.read(us(100.0) + 288U * static_cast<unsigned>(i), kNoon + i * 288'000 + (i > 50 ? step : 0));
      REQUIRE(reading.verdict == Verdict::kFits);
      REQUIRE(reading.time_ns - first == i * 288'000);
    }
  }
}

TEST_CASE("a damaged stamp is refused and forgotten", "[hdl64][device_clock]") {
  for (const std::uint32_t damaged : {0U, 50'000'000U, 1'000'000'000U, 0xFFFFFFFFU}) {
    DeviceClock clock;
    const std::int64_t first = clock.read(us(100.0), kNoon).time_ns;
    CHECK(clock.read(damaged, kNoon + 288'000).verdict == Verdict::kImplausible);
    const auto next = clock.read(us(100.0) + 576, kNoon + 576'000);
    CHECK(next.verdict == Verdict::kFits);
    CHECK(next.time_ns - first == 576'000);
    CHECK(clock.restarts() == 0);
  }
}

TEST_CASE("a sensor that was switched off and on restarts the clock", "[hdl64][device_clock]") {
  DeviceClock clock;
  clock.read(us(1234.5), kNoon);
  int refused = 0;
  DeviceClock::Reading reading;
  for (int i = 0; reading.verdict != Verdict::kRestarted; ++i) {
    reading = clock.read(us(3.0) + 288U * static_cast<unsigned>(i), kNoon + 25 * kSecond_ns + i * 288'000);
    if (reading.verdict == Verdict::kImplausible) ++refused;
    REQUIRE(i < 20);
  }
  CHECK(refused == 7);
  CHECK(clock.restarts() == 1);
  CHECK(std::abs(reading.time_ns - kNoon) < kHour_ns / 2);
  CHECK(clock.read(us(3.0) + 288 * 8, kNoon + 25 * kSecond_ns + 8 * 288'000).verdict == Verdict::kFits);
}

TEST_CASE("a clock that leaps to GPS time without any silence restarts", "[hdl64][device_clock]") {
  DeviceClock clock;
  clock.read(us(10.0), kNoon + 2000 * kSecond_ns);
  DeviceClock::Reading reading;
  for (unsigned i = 0; i < 8; ++i)
    reading = clock.read(us(2000.0) + 288 * i, kNoon + 2000 * kSecond_ns + 288'000 * (i + 1));
  CHECK(reading.verdict == Verdict::kRestarted);
  CHECK(reading.time_ns == kNoon + 2000 * kSecond_ns + 7 * 288'000);
}

TEST_CASE("stale packets among good ones do not restart the clock", "[hdl64][device_clock]") {
  DeviceClock clock;
  clock.read(us(100.0), kNoon);
  for (unsigned i = 1; i < 50; ++i) {
    REQUIRE(clock.read(us(99.0) + 288 * i, kNoon + 288'000 * i).verdict == Verdict::kImplausible);
    REQUIRE(clock.read(us(100.0) + 288 * i, kNoon + 288'000 * i).verdict == Verdict::kFits);
  }
  CHECK(clock.restarts() == 0);
}

TEST_CASE("a few packets that come much too late do not restart the clock", "[hdl64][device_clock]") {
  DeviceClock clock;
  clock.read(us(100.0), kNoon);
  for (unsigned i = 0; i < 7; ++i)
    CHECK(clock.read(us(99.9) + 288 * i, kNoon + 1000).verdict == Verdict::kImplausible);
  CHECK(clock.read(us(100.0) + 288, kNoon + 288'000).verdict == Verdict::kFits);
  CHECK(clock.restarts() == 0);
}
