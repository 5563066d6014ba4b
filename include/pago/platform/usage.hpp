// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/resource.h>

#include <cstdint>

namespace pago::platform {

/// [any thread] Page faults that the calling thread has taken without disk access, since it began. Does not
/// change once memory is locked and touched: the real-time threads' tests hold it to that. A system call of
/// about 0.4 us.
inline std::int64_t thread_minor_faults() noexcept {
  rusage usage{};
  getrusage(RUSAGE_THREAD, &usage);
  return usage.ru_minflt;
}

/// [any thread] The largest resident size that the process has had.
inline std::int64_t peak_resident_bytes() noexcept {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace pago::platform
