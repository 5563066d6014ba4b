// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/clock_offset.hpp"

#include <cmath>
#include <functional>
#include <random>

#include "support/catch.hpp"

using namespace pago::hdl64;

namespace {

constexpr std::int64_t kSecond = 1'000'000'000, kPeriod = 288'000, kSent = 100'000;
constexpr std::int64_t kSensor = 1'790'000'000 * kSecond;

/// Delays as a host has them: 20 us at best, 150 us in the mean, and now and then a stall of up to 80 ms in
/// which packets pile up.
class Delays {
 public:
  explicit Delays(unsigned seed) : random_(seed) {}
  std::int64_t next() {
    if (random_() % 20'000 == 0) stall_ns_ = static_cast<std::int64_t>(random_() % 80'000'000);
    stall_ns_ = std::max<std::int64_t>(0, stall_ns_ - kPeriod);
    return stall_ns_ + 20'000 + static_cast<std::int64_t>(130'000.0 * exponential_(random_));
  }

 private:
  std::mt19937 random_;
  std::exponential_distribution<double> exponential_;
  std::int64_t stall_ns_ = 0;
};

/// A host whose clock is ahead by `offset(t)` seconds, t seconds after the start.
struct Trial {
  std::function<double(double)> offset_s = [](double) { return 0.25; };
  unsigned seed = 1;
  double from_s = 10.0;  // errors count from here on

  double worst_s = 0.0, worst_rise = 0.0;
  ClockOffset clock{};

  void run(double begin_s, double end_s) {
    Delays delays(seed);
    std::int64_t last_ns = 0;
    const auto first = static_cast<std::int64_t>(begin_s * 1e9) / kPeriod;
    const auto last = static_cast<std::int64_t>(end_s * 1e9) / kPeriod;
    for (std::int64_t i = first; i < last; ++i) {
      const std::int64_t sensor_ns = kSensor + i * kPeriod;
      const double t = 1e-9 * static_cast<double>(i * kPeriod);
      const auto ahead_ns = static_cast<std::int64_t>(std::llround(offset_s(t) * 1e9));
      clock.add(sensor_ns, sensor_ns + kSent + ahead_ns + delays.next());
      if (i % 350 != 0) continue;
      const std::int64_t out_ns = clock.at(sensor_ns);
      if (t >= from_s) worst_s = std::max(worst_s, 1e-9 * std::abs(static_cast<double>(out_ns - ahead_ns)));
      if (t >= from_s && last_ns != 0)
        worst_rise =
            std::max(worst_rise, std::abs(static_cast<double>(out_ns - last_ns)) / (350.0 * kPeriod));
      last_ns = out_ns;
    }
  }
};

}  // namespace

TEST_CASE("a constant offset is found to 0.1 ms, through jitter and stalls", "[hdl64][clock_offset]") {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Trial trial{.seed = seed, .from_s = 1.0};
    trial.run(0.0, 60.0);
    CHECK(trial.worst_s < 1e-4);
    CHECK(std::abs(trial.clock.drift_ppm()) < 3.0);
    CHECK(trial.clock.steps() == 0);
  }
}

TEST_CASE("drift is followed, fast or slow, ahead or behind", "[hdl64][clock_offset]") {
  for (const double ppm : {-3300.0, -100.0, -20.0, 5.0, 50.0, 200.0, 3300.0}) {
    INFO(ppm << " ppm");
    Trial trial{.offset_s = [ppm](double t) { return -7.5 + ppm * 1e-6 * t; }, .from_s = 30.0};
    trial.run(0.0, 120.0);
    CHECK(trial.worst_s < 3e-4);
    CHECK(trial.clock.drift_ppm() == Approx(ppm).margin(4.0));
    CHECK(trial.worst_rise < std::abs(ppm) * 1e-6 + 1.01e-3);
    CHECK(trial.clock.steps() == 0);
  }
}

TEST_CASE("a drift that changes with temperature is followed", "[hdl64][clock_offset]") {
  // 40 ppm back and forth in ten minutes.
  Trial trial{.offset_s = [](double t) { return 40e-6 * 95.5 * (1.0 - std::cos(t / 95.5)); }, .from_s = 30.0};
  trial.run(0.0, 600.0);
  CHECK(trial.worst_s < 1e-3);
}

TEST_CASE("a host's clock that is set makes the offset step, both ways, within seconds",
          "[hdl64][clock_offset]") {
  for (const double step_s : {-86'400.0, -1.0, -0.2, 0.2, 1.0, 86'400.0}) {
    INFO(step_s << " s");
    const auto offset_s = [step_s](double t) { return t < 40.0 ? 0.0 : step_s; };
    Trial trial{.offset_s = offset_s};
    trial.run(0.0, 39.9);
    CHECK(trial.worst_s < 1e-4);
    trial.worst_s = 0.0;
    trial.from_s = 46.0;
    trial.run(39.9, 80.0);
    CHECK(trial.worst_s < 2e-4);
    CHECK(trial.clock.steps() == 1);
  }
}

TEST_CASE("a stall of two seconds is no step", "[hdl64][clock_offset]") {
  ClockOffset clock;
  for (std::int64_t i = 0; i < 200'000; ++i) {
    const std::int64_t sensor_ns = kSensor + i * kPeriod;
    const bool is_stalled = i > 100'000 && i < 107'000;
    const std::int64_t waiting_ns = is_stalled ? (107'000 - i) * kPeriod : 0;
    clock.add(sensor_ns, sensor_ns + kSent + waiting_ns);
    REQUIRE(std::abs(clock.at(sensor_ns)) < 10'000);
  }
  CHECK(clock.steps() == 0);
}

TEST_CASE("a few packets with wrong arrival times change nothing", "[hdl64][clock_offset]") {
  ClockOffset clock;
  for (std::int64_t i = 0; i < 100'000; ++i) {
    const std::int64_t sensor_ns = kSensor + i * kPeriod;
    const std::int64_t wrong_ns = i % 5000 < 300 && i > 1000 ? -10 * kSecond : 0;
    clock.add(sensor_ns, sensor_ns + kSent + wrong_ns);
    REQUIRE(std::abs(clock.at(sensor_ns)) < 10'000);
  }
  CHECK(clock.steps() == 0);
}

TEST_CASE("the first packet's offset is known at once", "[hdl64][clock_offset]") {
  ClockOffset clock;
  CHECK(clock.at(kSensor) == 0);
  clock.add(kSensor, kSensor + kSent + 5 * kSecond);
  CHECK(clock.at(kSensor) == 5 * kSecond);
  clock.restart();
  clock.add(kSensor, kSensor + kSent - kSecond);
  CHECK(clock.at(kSensor) == -kSecond);
  CHECK(clock.steps() == 0);
}

TEST_CASE("half an hour's silence keeps the offset", "[hdl64][clock_offset]") {
  Trial trial{.offset_s = [](double t) { return 20e-6 * t; }};
  trial.run(0.0, 60.0);
  CHECK(trial.worst_s < 2e-4);
  trial.worst_s = 0.0;
  trial.from_s = 1890.0;
  trial.run(1860.0, 1920.0);
  CHECK(trial.worst_s < 2e-3);
  CHECK(trial.clock.steps() == 0);
}
