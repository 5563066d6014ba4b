// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/doctor.hpp"

#include <algorithm>
#include <fstream>

#include "pago/platform/clock.hpp"
#include "pago/platform/jitter.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using namespace pago::platform;
namespace fs = std::filesystem;

namespace {

/// A host made of files.
class Host {
 public:
  Host() : root_("") {
    write("proc/version", "Linux version 6.1.0-rt7 (SMP PREEMPT_RT)");
    write("proc/sys/net/core/rmem_max", "8388608");
    write("proc/sys/kernel/sched_rt_runtime_us", "950000");
    write("proc/sys/kernel/sched_rt_period_us", "1000000");
    write("proc/swaps", "Filename Type Size Used Priority");
    write("proc/interrupts", "           CPU0 CPU1\n 24: 10 0 PCI-MSI eth0-rx\n 25: 1 1 PCI-MSI nvme0");
    write("proc/irq/24/smp_affinity_list", "0");
    write("sys/class/net/eth0/mtu", "1500");
    write("sys/class/net/lo/mtu", "65536");
    write("sys/devices/system/cpu/isolated", "1");
    write("sys/devices/system/cpu/cpu0/cpufreq/scaling_governor", "performance");
    write("sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "performance");
    write("sys/devices/system/clocksource/clocksource0/current_clocksource", "tsc");
  }
  void write(const std::string& file, const std::string& text) {
    fs::create_directories((root_.path() / file).parent_path());
    std::ofstream(root_.path() / file) << text << '\n';
  }
  std::vector<Finding> examine() const { return examine_host(root_.path()); }
  Finding find(const std::string& what) const {
    const auto findings = examine();
    const auto found = std::ranges::find(findings, what, &Finding::what);
    REQUIRE(found != findings.end());
    return *found;
  }

 private:
  test::TemporaryPath root_;
};

}  // namespace

TEST_CASE("a host that is fit has nothing to mend", "[platform][doctor]") {
  for (const Finding& finding : Host().examine()) {
    INFO(finding.what << ": " << finding.found);
    CHECK(finding.verdict == Verdict::kGood);
    CHECK(finding.fix.empty());
  }
}

TEST_CASE("each weakness is found and comes with its fix", "[platform][doctor]") {
  struct Case {
    const char *file, *content, *what;
    Verdict verdict;
    const char *found, *fix;
  };
  const std::vector<Case> cases{
      {"sys/devices/system/cpu/cpu1/cpufreq/scaling_governor", "powersave", "CPU frequency",
       Verdict::kCouldBeBetter, "powersave on 1 cores", "cpupower"},
      {"sys/devices/system/cpu/isolated", "", "isolated cores", Verdict::kCouldBeBetter, "none", "isolcpus"},
      {"proc/version", "Linux version 6.1.0 PREEMPT_DYNAMIC", "kernel", Verdict::kCouldBeBetter,
       "not a real-time", "linux-image-rt"},
      {"sys/devices/system/clocksource/clocksource0/current_clocksource", "hpet", "clock source",
       Verdict::kBad, "hpet", "clocksource=tsc"},
      {"proc/sys/net/core/rmem_max", "212992", "receive buffer", Verdict::kBad, "53 ms", "rmem_max=4194304"},
      {"proc/sys/kernel/sched_rt_runtime_us", "500000", "real-time share", Verdict::kBad, "50 %",
       "sched_rt_runtime_us"},
      {"proc/swaps", "Filename\n/swapfile file 1 0 -2", "swap", Verdict::kCouldBeBetter, "1 areas",
       "swapoff"},
      {"proc/irq/24/smp_affinity_list", "0-1", "network interrupts", Verdict::kCouldBeBetter, "cpu 0-1",
       "smp_affinity_list"},
  };
  for (const Case& c : cases) {
    Host host;
    host.write(c.file, c.content);
    const Finding finding = host.find(c.what);
    INFO(c.what << ": " << finding.found << " -> " << finding.fix);
    CHECK(finding.verdict == c.verdict);
    CHECK_THAT(finding.found, Catch::Contains(c.found));
    CHECK_THAT(finding.fix, Catch::Contains(c.fix));
  }
}

TEST_CASE("this process and this host can be examined, whatever they are", "[platform][doctor]") {
  CHECK(examine_host().size() == 8);
  CHECK(examine_process().size() == 2);
  const Pulse pulse = feel_pulse(0.05);
  CHECK(pulse.jitter.count() > 0);
  CHECK(judge(pulse).size() == 2);
}

TEST_CASE("a pulse is judged by its tail", "[platform][doctor]") {
  Pulse pulse;
  for (int i = 0; i < 1000; ++i) pulse.jitter.record(50'000);
  CHECK(judge(pulse)[0].verdict == Verdict::kGood);
  for (int i = 0; i < 10; ++i) pulse.jitter.record(2'000'000);
  CHECK(judge(pulse)[0].verdict == Verdict::kCouldBeBetter);
  for (int i = 0; i < 10; ++i) pulse.jitter.record(20'000'000);
  CHECK(judge(pulse)[0].verdict == Verdict::kBad);
  pulse.steal_percent = 6.0;
  CHECK(judge(pulse)[1].verdict == Verdict::kBad);
}

TEST_CASE("a meter counts each period once, and its own lateness", "[platform][jitter]") {
  JitterMeter meter({.name = "meter"}, 1'000'000);
  sleep_until_ns(monotonic_ns() + 30'000'000);
  const LatencyHistogram& lateness = meter.stop();
  CHECK(lateness.count() >= 1);
  CHECK(lateness.count() <= 40);
  CHECK(lateness.max() > 0);
}
