// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace pago::platform {

/// What is asked for a thread.
struct ThreadPlan {
  std::string name;       ///< at most 15 characters, as `top -H` and the kernel's traces show it
  int cpu = -1;           ///< run on this one only; -1: on any
  int fifo_priority = 0;  ///< 1 ... 99 SCHED_FIFO; 0: normal scheduling
  std::size_t stack_bytes = 2U << 20U;             ///< with locked memory all of it becomes resident
  std::size_t stack_prefault_bytes = 512U << 10U;  ///< touched before the body runs; less than stack_bytes
};

/// What the kernel granted.
struct ThreadGrant {
  int cpu = -1;
  int fifo_priority = 0;
  std::string refusal;  ///< what was not given and why, e.g. "FIFO 80: Operation not permitted"; or empty
};

/// One line for start-up, e.g. "ingest: any cpu, normal priority (refused: FIFO 80: Operation not
/// permitted)".
std::string describe(const ThreadPlan& plan, const ThreadGrant& grant);

/// A named thread that is joined when its handle goes. Privileges are asked for, not needed: without them it
/// runs with normal scheduling, and grant() says so.
class Thread {
 public:
  Thread() = default;
  /// [set-up] Returns when the thread has its name, core, priority and stack, just before `body` runs on it.
  /// `body` must not throw. Throws Error if no thread can be made.
  Thread(ThreadPlan plan, std::function<void()> body);
  Thread(Thread&&) noexcept = default;
  Thread& operator=(Thread&& other) noexcept;
  ~Thread();

  /// Waits for the body's end; no effect without a running thread.
  void join() noexcept;

  /// Of a thread that was started.
  const ThreadPlan& plan() const noexcept;
  const ThreadGrant& grant() const noexcept;

 private:
  struct State;
  struct Free {
    void operator()(State* state) const noexcept;
  };
  std::unique_ptr<State, Free> state_;
};

/// [any thread] The ThreadPlan's name; "" on a thread that nobody named. Safe everywhere, also inside malloc.
const char* current_thread_name() noexcept;

/// Names the calling thread, e.g. main when it does a stage's work itself. Beyond 15 characters it is cut.
void name_current_thread(std::string_view name) noexcept;

}  // namespace pago::platform
