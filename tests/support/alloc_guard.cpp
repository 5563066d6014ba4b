// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "support/alloc_guard.hpp"

#include <execinfo.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>

#include "pago/platform/thread.hpp"
#include "support/alloc_guard_hooks.hpp"

namespace pago::test {

namespace {

struct Calls {
  std::uint64_t allocations = 0, frees = 0;
};
// No constructors: the C library allocates before any has run.
constinit thread_local Calls calls_of_this_thread;

/// A thread name that is watched. Written while disarmed; only the count changes afterwards.
struct Watched {
  std::array<char, 16> name{};
  std::atomic<std::uint64_t> calls{0};
};
constinit std::array<Watched, 8> watched;
constinit std::atomic<std::size_t> num_watched{0};  // 0: disarmed

/// The stack of the first call that was counted.
constexpr int kMaxFrames = 24;
constinit std::array<void*, kMaxFrames> first_stack{};
constinit std::atomic<int> num_frames{0};
constinit std::atomic<bool> has_first{false};

void remember_stack() noexcept {
  if (has_first.exchange(true)) return;
  num_frames.store(backtrace(first_stack.data(), kMaxFrames), std::memory_order_release);
}

Watched* find(std::string_view thread_name, std::size_t count) noexcept {
  const auto end = watched.begin() + static_cast<std::ptrdiff_t>(count);
  const auto found =
      std::find_if(watched.begin(), end, [&](const Watched& w) { return w.name.data() == thread_name; });
  return found == end ? nullptr : &*found;
}

void count_if_watched() noexcept {
  // Acquire, pairs with arm(): who sees the number sees the names.
  const std::size_t count = num_watched.load(std::memory_order_acquire);
  if (count == 0) return;
  Watched* const entry = find(platform::current_thread_name(), count);
  if (entry == nullptr) return;
  entry->calls.fetch_add(1, std::memory_order_relaxed);
  remember_stack();
}

}  // namespace

void on_allocate() noexcept {
  ++calls_of_this_thread.allocations;
  count_if_watched();
}

void on_free() noexcept {
  ++calls_of_this_thread.frees;
  count_if_watched();
}

AllocationGuard::AllocationGuard() noexcept
    : allocations_before_(calls_of_this_thread.allocations), frees_before_(calls_of_this_thread.frees) {}
std::uint64_t AllocationGuard::allocations() const noexcept {
  return calls_of_this_thread.allocations - allocations_before_;
}
std::uint64_t AllocationGuard::frees() const noexcept {
  return calls_of_this_thread.frees - frees_before_;
}

void RealtimeThreads::arm(std::initializer_list<std::string_view> thread_names) noexcept {
  disarm();
  // The first backtrace of a process loads a library, which allocates: here it does no harm.
  backtrace(first_stack.data(), kMaxFrames);
  num_frames = 0;
  has_first = false;
  if (thread_names.size() > watched.size()) std::abort();
  auto* entry = watched.begin();
  for (const std::string_view name : thread_names) {
    entry->name = {};
    name.copy(entry->name.data(), entry->name.size() - 1);
    (entry++)->calls = 0;
  }
  num_watched.store(thread_names.size(), std::memory_order_release);
}

void RealtimeThreads::disarm() noexcept {
  num_watched = 0;
}

std::uint64_t RealtimeThreads::count(std::string_view thread_name) noexcept {
  const Watched* const entry = find(thread_name, watched.size());
  if (entry == nullptr) std::abort();
  return entry->calls;
}

std::string RealtimeThreads::first_call() {
  std::string lines;
  const int frames = num_frames.load(std::memory_order_acquire);
  char** const symbols = backtrace_symbols(first_stack.data(), frames);
  for (int i = 0; symbols != nullptr && i < frames; ++i) lines += std::string(symbols[i]) + '\n';
  std::free(symbols);
  return lines;
}

}  // namespace pago::test
