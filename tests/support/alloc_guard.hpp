// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

/// Counts every call that goes to the heap, by thread. Programs that link `pago_alloc_guard` have it: malloc
/// and its whole family are replaced at link time, and operator new and delete, Eigen and the C library end
/// there too. Under a sanitizer, which has replaced them already, its hooks count instead (g++ 12's
/// ThreadSanitizer misses aligned allocations by C functions, but not their frees).
namespace pago::test {

/// What the calling thread does with the heap while the object lives. Freeing counts as well: it takes the
/// same locks.
class AllocationGuard {
 public:
  AllocationGuard() noexcept;
  std::uint64_t allocations() const noexcept;
  std::uint64_t frees() const noexcept;
  std::uint64_t count() const noexcept { return allocations() + frees(); }

 private:
  std::uint64_t allocations_before_, frees_before_;
};

/// What the threads of a pipeline do with the heap between arm() and disarm(), each known by its ThreadPlan's
/// name. A name that no thread has counts 0 for ever, so let every test that wants 0 also provoke a 1.
struct RealtimeThreads {
  /// Sets all counts to 0 and watches the threads of these names (at most 8), present and future. May be
  /// called from any one of them.
  static void arm(std::initializer_list<std::string_view> thread_names) noexcept;
  static void disarm() noexcept;

  /// Allocations and frees since arm(); `thread_name` must be one that was given to it.
  static std::uint64_t count(std::string_view thread_name) noexcept;

  /// Where the first counted call came from, a line per stack frame, for addr2line; empty if there was none.
  static std::string first_call();
};

}  // namespace pago::test
