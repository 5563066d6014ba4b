// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pago/core/histogram.hpp"

/// Whether a host is fit for a real-time pipeline, and what would make it fitter. [set-up] all of it.
namespace pago::platform {

enum class Verdict { kGood, kCouldBeBetter, kBad };
std::string_view to_string(Verdict verdict) noexcept;

struct Finding {
  std::string what;  ///< "CPU frequency"
  Verdict verdict = Verdict::kGood;
  std::string found;  ///< "governor powersave on cpu 0-3"
  std::string fix;    ///< a command or setting; empty where nothing need be done
};

/// What the host's /proc and /sys say: frequency governor, isolated cores, real-time kernel, clock source,
/// limit of receive buffers, share of real-time threads, swap, interrupts of network cards. `root` stands for
/// / in tests.
std::vector<Finding> examine_host(const std::filesystem::path& root = "/");

/// What this process may do: real-time priority, locked memory.
std::vector<Finding> examine_process();

/// What the host's timers do for some seconds: jitter of a 1 ms timer on each core, at real-time priority
/// where that is allowed, and the time that the hypervisor took.
struct Pulse {
  LatencyHistogram jitter;  ///< over all cores
  double steal_percent = 0.0;
  bool is_real_time = false;
};
Pulse feel_pulse(double seconds);
std::vector<Finding> judge(const Pulse& pulse);

}  // namespace pago::platform
