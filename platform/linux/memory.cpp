// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/memory.hpp"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/prctl.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <system_error>

namespace pago::platform {

std::string lock_memory() {
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return "memory is not locked: " + std::generic_category().message(errno) +
         " (allow it with LimitMEMLOCK=infinity in the unit, or `ulimit -l unlimited`)";
}

void keep_heap(std::size_t reserve_bytes) {
  mallopt(M_MMAP_MAX, 0);
  mallopt(M_TRIM_THRESHOLD, -1);
  mallopt(M_ARENA_MAX, 1);
  void* const reserve = std::malloc(reserve_bytes);
  if (reserve != nullptr) std::memset(reserve, 1, reserve_bytes);
  // Keeps the compiler from removing a pair of malloc and free.
  asm volatile("" : : "r"(reserve) : "memory");
  std::free(reserve);
}

void make_timers_exact() noexcept {
  prctl(PR_SET_TIMERSLACK, 1UL, 0UL, 0UL, 0UL);
}

}  // namespace pago::platform
