// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <fstream>
#include <memory>
#include <string>
#include <thread>

#include "pago/core/text.hpp"
#include "pago/platform/doctor.hpp"
#include "pago/platform/jitter.hpp"

namespace pago::platform {

namespace {

struct CpuTime {
  double total = 0.0, steal = 0.0;
};

/// proc(5): user nice system idle iowait irq softirq steal, in ticks since boot.
CpuTime cpu_time() {
  std::ifstream in("/proc/stat");
  std::string word;
  in >> word;
  CpuTime time;
  constexpr int kSteal = 7;
  for (int i = 0; i <= kSteal; ++i) {
    double ticks = 0.0;
    in >> ticks;
    time.total += ticks;
    if (i == kSteal) time.steal = ticks;
  }
  return time;
}

}  // namespace

Pulse feel_pulse(double seconds) {
  constexpr std::int64_t kPeriod_ns = 1'000'000;
  const CpuTime before = cpu_time();
  std::vector<std::unique_ptr<JitterMeter>> meters;
  for (unsigned cpu = 0; cpu < std::max(1U, std::thread::hardware_concurrency()); ++cpu) {
    ThreadPlan plan;
    plan.name = "pulse";
    plan.cpu = static_cast<int>(cpu);
    plan.fifo_priority = 80;
    meters.push_back(std::make_unique<JitterMeter>(plan, kPeriod_ns));
  }
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  Pulse pulse;
  pulse.is_real_time = true;
  for (const auto& meter : meters) {
    pulse.is_real_time = pulse.is_real_time && meter->thread().grant().fifo_priority > 0;
    pulse.jitter.merge(meter->stop());
  }
  const CpuTime after = cpu_time();
  if (after.total > before.total)
    pulse.steal_percent = 100.0 * (after.steal - before.steal) / (after.total - before.total);
  return pulse;
}

std::vector<Finding> judge(const Pulse& pulse) {
  const auto us = [](std::int64_t ns) { return static_cast<double>(ns) * 1e-3; };
  constexpr std::int64_t kFine_ns = 1'000'000, kBad_ns = 10'000'000;
  const std::int64_t p999_ns = pulse.jitter.percentile(99.9);
  Finding jitter{"timer jitter", Verdict::kGood,
                 format("%s: p50 %.0f, p99 %.0f, p99.9 %.0f, max %.0f us",
                        pulse.is_real_time ? "real-time" : "normal priority", us(pulse.jitter.percentile(50)),
                        us(pulse.jitter.percentile(99)), us(p999_ns), us(pulse.jitter.max())),
                 ""};
  if (p999_ns > kFine_ns) {
    jitter.verdict = p999_ns > kBad_ns ? Verdict::kBad : Verdict::kCouldBeBetter;
    jitter.fix = "see the other findings; on a virtual machine it may be the host's doing";
  }
  Finding steal{"stolen time", Verdict::kGood, format("%.2f %%", pulse.steal_percent), ""};
  if (pulse.steal_percent > 0.5) {
    steal.verdict = pulse.steal_percent > 5.0 ? Verdict::kBad : Verdict::kCouldBeBetter;
    steal.fix = "the hypervisor runs others on these cores: reserve them for this machine";
  }
  return {jitter, steal};
}

}  // namespace pago::platform
