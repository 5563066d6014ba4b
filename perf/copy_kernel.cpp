// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "copy_kernel.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstring>

#include "pago/platform/clock.hpp"

namespace pago::perf {

// Different values in both, so that neither lives in pages that the kernel shares.
CopyKernel::CopyKernel(std::size_t bytes) : source_(bytes, 1), target_(bytes, 2) {}

double CopyKernel::run_ms() noexcept {
  std::int64_t best_ns = INT64_MAX;
  for (int i = 0; i < 4; ++i) {
    const std::int64_t before_ns = platform::thread_cpu_ns();
    copy();
    best_ns = std::min(best_ns, platform::thread_cpu_ns() - before_ns);
  }
  return static_cast<double>(best_ns) * 1e-6;
}

void CopyKernel::copy() noexcept {
  std::memcpy(target_.data(), source_.data(), source_.size());
  benchmark::DoNotOptimize(target_.data());
  benchmark::ClobberMemory();
}

}  // namespace pago::perf
