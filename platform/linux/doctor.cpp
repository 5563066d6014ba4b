// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/doctor.hpp"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <system_error>

#include "pago/core/text.hpp"
#include "pago/platform/thread.hpp"

namespace pago::platform {

namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

std::vector<fs::path> entries(const fs::path& folder, const std::string& prefix) {
  std::vector<fs::path> result;
  std::error_code unknown;
  for (const auto& entry : fs::directory_iterator(folder, unknown))
    if (entry.path().filename().string().starts_with(prefix)) result.push_back(entry.path());
  std::ranges::sort(result);
  return result;
}

Finding governor(const fs::path& root) {
  std::map<std::string, int> cores;
  for (const fs::path& cpu : entries(root / "sys/devices/system/cpu", "cpu")) {
    const std::string name = first_line(cpu / "cpufreq/scaling_governor");
    if (!name.empty()) ++cores[name];
  }
  if (cores.empty()) return {"CPU frequency", Verdict::kGood, "set by the hardware or the hypervisor", ""};
  if (cores.size() == 1 && cores.contains("performance"))
    return {"CPU frequency", Verdict::kGood, "governor performance on all cores", ""};
  std::string found = "governor";
  for (const auto& [name, count] : cores) found += format(" %s on %d cores", name.c_str(), count);
  return {"CPU frequency", Verdict::kCouldBeBetter, found, "cpupower frequency-set -g performance"};
}

Finding isolation(const fs::path& root) {
  const std::string isolated = first_line(root / "sys/devices/system/cpu/isolated");
  if (!isolated.empty()) return {"isolated cores", Verdict::kGood, isolated, ""};
  return {"isolated cores", Verdict::kCouldBeBetter, "none: other programs run on the pipeline's cores",
          "kernel parameters isolcpus=managed_irq,domain,1 nohz_full=1 rcu_nocbs=1 irqaffinity=0 keep core 1 "
          "free"};
}

Finding preemption(const fs::path& root) {
  const std::string version = first_line(root / "proc/version");
  if (version.find("PREEMPT_RT") != std::string::npos) return {"kernel", Verdict::kGood, "PREEMPT_RT", ""};
  return {"kernel", Verdict::kCouldBeBetter,
          "not a real-time kernel: a few milliseconds of latency now and then",
          "apt install linux-image-rt-amd64"};
}

Finding clock_source(const fs::path& root) {
  const std::string name =
      first_line(root / "sys/devices/system/clocksource/clocksource0/current_clocksource");
  const bool is_fast = name == "tsc" || name == "kvm-clock" || name == "arch_sys_counter";
  if (is_fast) return {"clock source", Verdict::kGood, name, ""};
  return {"clock source", Verdict::kBad,
          (name.empty() ? "unknown" : name) + ": reading the time is a system call",
          "kernel parameter clocksource=tsc, if the processor's is stable"};
}

Finding receive_buffer(const fs::path& root) {
  constexpr long kWanted_bytes = 4 << 20;
  const long limit = std::atol(first_line(root / "proc/sys/net/core/rmem_max").c_str());
  const std::string found = format("at most %ld bytes asked: %.0f ms of an HDL-64E", limit,
                                   2000.0 * static_cast<double>(limit) / 2304.0 / 3472.0);
  if (limit >= kWanted_bytes) return {"receive buffer", Verdict::kGood, found, ""};
  return {"receive buffer", Verdict::kBad, found, "sysctl -w net.core.rmem_max=4194304 (or CAP_NET_ADMIN)"};
}

Finding real_time_share(const fs::path& root) {
  const long runtime_us = std::atol(first_line(root / "proc/sys/kernel/sched_rt_runtime_us").c_str());
  const long period_us = std::atol(first_line(root / "proc/sys/kernel/sched_rt_period_us").c_str());
  if (runtime_us < 0 || period_us <= 0 || 10 * runtime_us >= 9 * period_us)
    return {"real-time share", Verdict::kGood, "95 % of a core or more", ""};
  return {"real-time share", Verdict::kBad,
          format("real-time threads may use %.0f %% of a core",
                 100.0 * static_cast<double>(runtime_us) / static_cast<double>(period_us)),
          "sysctl -w kernel.sched_rt_runtime_us=950000"};
}

Finding swap(const fs::path& root) {
  std::ifstream in(root / "proc/swaps");
  std::string line;
  int areas = -1;  // a heading
  while (std::getline(in, line)) ++areas;
  if (areas <= 0) return {"swap", Verdict::kGood, "none", ""};
  return {"swap", Verdict::kCouldBeBetter, format("%d areas: harmless while memory is locked", areas),
          "swapoff -a"};
}

/// Interrupt numbers that /proc/interrupts gives to network cards.
std::set<std::string> network_interrupts(const fs::path& root) {
  std::set<std::string> names, numbers;
  for (const fs::path& card : entries(root / "sys/class/net", "")) names.insert(card.filename().string());
  names.erase("lo");
  std::ifstream in(root / "proc/interrupts");
  for (std::string line; std::getline(in, line);) {
    const bool is_network = std::ranges::any_of(
        names, [&](const std::string& name) { return line.find(name) != std::string::npos; });
    std::istringstream words(line);
    std::string number;
    if (is_network && words >> number) numbers.insert(number.substr(0, number.find(':')));
  }
  return numbers;
}

Finding interrupts(const fs::path& root) {
  const std::set<std::string> numbers = network_interrupts(root);
  std::set<std::string> cores;
  for (const std::string& number : numbers)
    cores.insert(first_line(root / "proc/irq" / number / "smp_affinity_list"));
  if (numbers.empty()) return {"network interrupts", Verdict::kGood, "none found", ""};
  std::string where;
  for (const std::string& list : cores) where += (where.empty() ? "cpu " : ", ") + list;
  if (cores.size() == 1 && *cores.begin() == "0")
    return {"network interrupts", Verdict::kGood, "on cpu 0, where packets are received", ""};
  return {
      "network interrupts", Verdict::kCouldBeBetter, "on " + where,
      "echo 0 > /proc/irq/N/smp_affinity_list keeps them off the estimate thread's core; stop irqbalance"};
}

/// Empty if as much as a pipeline needs can be locked, else why not.
std::string try_to_lock() {
  constexpr std::size_t kPipeline_bytes = 256U << 20U;
  void* const memory = mmap(nullptr, kPipeline_bytes, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return "no memory to try it with";
  const bool is_locked = mlock(memory, kPipeline_bytes) == 0;
  const int error = errno;
  munmap(memory, kPipeline_bytes);
  return is_locked ? std::string() : "256 MB cannot be locked: " + std::generic_category().message(error);
}

}  // namespace

std::string_view to_string(Verdict verdict) noexcept {
  constexpr std::array<std::string_view, 3> kWords{"good", "could be better", "bad"};
  return kWords[static_cast<std::size_t>(verdict)];
}

std::vector<Finding> examine_host(const fs::path& root) {
  return {governor(root),       isolation(root),       preemption(root), clock_source(root),
          receive_buffer(root), real_time_share(root), swap(root),       interrupts(root)};
}

std::vector<Finding> examine_process() {
  std::vector<Finding> findings;
  ThreadPlan plan;
  plan.name = "doctor";
  plan.fifo_priority = 80;
  const Thread probe(plan, [] {});
  if (probe.grant().fifo_priority > 0)
    findings.push_back({"real-time priority", Verdict::kGood, "SCHED_FIFO is allowed", ""});
  else
    findings.push_back(
        {"real-time priority", Verdict::kBad, probe.grant().refusal,
         "run as the systemd unit (AmbientCapabilities=CAP_SYS_NICE), or add '@pago - rtprio 90' "
         "to /etc/security/limits.conf"});
  const std::string refusal = try_to_lock();
  if (refusal.empty())
    findings.push_back({"locked memory", Verdict::kGood, "allowed", ""});
  else
    findings.push_back({"locked memory", Verdict::kBad, refusal,
                        "LimitMEMLOCK=infinity in the unit, or '@pago - memlock unlimited' in limits.conf"});
  return findings;
}

}  // namespace pago::platform
