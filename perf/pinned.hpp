// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <thread>

#include "pago/platform/thread.hpp"

namespace pago::perf {

inline constexpr int kFifoPriority = 50;

/// A thread of its own core, as the pipeline's are: `core` counts around where the machine has fewer.
inline platform::ThreadPlan pinned(const char* name, int core, int fifo_priority) {
  const int cores = static_cast<int>(std::thread::hardware_concurrency());
  platform::ThreadPlan plan;
  plan.name = name;
  plan.cpu = cores > 0 ? core % cores : -1;
  plan.fifo_priority = fifo_priority;
  return plan;
}

/// "FIFO 50", or what came of it.
inline std::string scheduling_of(const platform::Thread& thread) {
  const int priority = thread.grant().fifo_priority;
  if (priority > 0) return "FIFO " + std::to_string(priority);
  return thread.plan().fifo_priority > 0 ? "normal (FIFO refused)" : "normal";
}

}  // namespace pago::perf
