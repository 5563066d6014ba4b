// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/thread.hpp"

#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <system_error>

#include "pago/core/error.hpp"

namespace pago::platform {

namespace {

/// Plain bytes, no constructor: reading it never allocates.
constinit thread_local char thread_name[16] = "";

std::string reason(int error_number) {
  return std::generic_category().message(error_number);
}

void refuse(ThreadGrant& grant, const std::string& what, int error_number) {
  if (!grant.refusal.empty()) grant.refusal += "; ";
  grant.refusal += what + ": " + reason(error_number);
}

void ask_for_cpu(int cpu, ThreadGrant& grant) {
  if (cpu < 0) return;
  cpu_set_t set;
  CPU_ZERO(&set);
  if (cpu < CPU_SETSIZE) CPU_SET(static_cast<std::size_t>(cpu), &set);
  const int error = pthread_setaffinity_np(pthread_self(), sizeof(set), &set);
  if (error != 0) return refuse(grant, "cpu " + std::to_string(cpu), error);
  grant.cpu = cpu;
}

/// Normal scheduling is asked for too: a thread would otherwise inherit its creator's.
void ask_for_priority(int priority, ThreadGrant& grant) {
  const sched_param wanted{.sched_priority = std::max(0, priority)};
  const int policy = priority > 0 ? SCHED_FIFO : SCHED_OTHER;
  const int error = pthread_setschedparam(pthread_self(), policy, &wanted);
  if (error != 0) return refuse(grant, "FIFO " + std::to_string(priority), error);
  grant.fifo_priority = wanted.sched_priority;
}

/// Takes the page faults of the first deep call now instead of in the middle of a sweep.
[[gnu::noinline]] void touch_stack(std::size_t bytes) noexcept {
  constexpr std::size_t kPageBytes = 4096;
  auto* const stack = static_cast<volatile char*>(__builtin_alloca(bytes));
  for (std::size_t i = 0; i < bytes; i += kPageBytes) stack[i] = 0;
}

}  // namespace

struct Thread::State {
  ThreadPlan plan;
  std::function<void()> body;
  ThreadGrant grant;
  std::atomic<bool> has_begun{false};
  pthread_t handle{};
  bool is_joinable = false;

  static void* run(void* argument) {
    State& state = *static_cast<State*>(argument);
    name_current_thread(state.plan.name);
    ask_for_cpu(state.plan.cpu, state.grant);
    ask_for_priority(state.plan.fifo_priority, state.grant);
    touch_stack(state.plan.stack_prefault_bytes);
    // Release, pairs with the constructor's wait: who sees it sees the grant.
    state.has_begun.store(true, std::memory_order_release);
    state.has_begun.notify_one();
    state.body();
    return nullptr;
  }
};

void Thread::Free::operator()(State* state) const noexcept {
  delete state;
}

Thread::Thread(ThreadPlan plan, std::function<void()> body) : state_(new State{}) {
  state_->plan = std::move(plan);
  state_->body = std::move(body);
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  int error = pthread_attr_setstacksize(&attributes, state_->plan.stack_bytes);
  if (error == 0) error = pthread_create(&state_->handle, &attributes, &State::run, state_.get());
  pthread_attr_destroy(&attributes);
  if (error != 0) {
    throw Error("thread " + state_->plan.name, "cannot be started: " + reason(error),
                "see `ulimit -u` and `ulimit -v`");
  }
  state_->is_joinable = true;
  state_->has_begun.wait(false, std::memory_order_acquire);
}

Thread& Thread::operator=(Thread&& other) noexcept {
  join();
  state_ = std::move(other.state_);
  return *this;
}

Thread::~Thread() {
  join();
}

void Thread::join() noexcept {
  if (state_ == nullptr || !state_->is_joinable) return;
  pthread_join(state_->handle, nullptr);
  state_->is_joinable = false;
}

const ThreadPlan& Thread::plan() const noexcept {
  return state_->plan;
}
const ThreadGrant& Thread::grant() const noexcept {
  return state_->grant;
}

std::string describe(const ThreadPlan& plan, const ThreadGrant& grant) {
  std::string line = plan.name + ": ";
  line += grant.cpu < 0 ? "any cpu" : "cpu " + std::to_string(grant.cpu);
  line += grant.fifo_priority == 0 ? ", normal priority" : ", FIFO " + std::to_string(grant.fifo_priority);
  return grant.refusal.empty() ? line : line + " (refused: " + grant.refusal + ")";
}

const char* current_thread_name() noexcept {
  return thread_name;
}

void name_current_thread(std::string_view name) noexcept {
  const std::size_t length = std::min(name.size(), sizeof(thread_name) - 1);
  std::memcpy(thread_name, name.data(), length);
  thread_name[length] = '\0';
  pthread_setname_np(pthread_self(), thread_name);
}

}  // namespace pago::platform
