// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/thread.hpp"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "pago/core/error.hpp"
#include "pago/platform/clock.hpp"
#include "support/catch.hpp"

using namespace pago::platform;

namespace {

/// What the running thread finds out about itself.
struct Self {
  std::string name, kernel_name;
  int policy = -1, priority = -1, num_cpus = 0;
  std::size_t stack_bytes = 0;
};

Self look_at_self() {
  Self self;
  self.name = current_thread_name();
  char name[16];
  pthread_getname_np(pthread_self(), name, sizeof(name));
  self.kernel_name = name;
  sched_param parameters{};
  pthread_getschedparam(pthread_self(), &self.policy, &parameters);
  self.priority = parameters.sched_priority;
  cpu_set_t cpus;
  pthread_getaffinity_np(pthread_self(), sizeof(cpus), &cpus);
  self.num_cpus = CPU_COUNT(&cpus);
  pthread_attr_t attributes;
  pthread_getattr_np(pthread_self(), &attributes);
  pthread_attr_getstacksize(&attributes, &self.stack_bytes);
  pthread_attr_destroy(&attributes);
  return self;
}

Self run_and_look(const ThreadPlan& plan, ThreadGrant& grant) {
  Self self;
  Thread thread(plan, [&] { self = look_at_self(); });
  grant = thread.grant();
  thread.join();
  return self;
}

int first_allowed_cpu() {
  cpu_set_t cpus;
  pthread_getaffinity_np(pthread_self(), sizeof(cpus), &cpus);
  std::size_t cpu = 0;
  while (!CPU_ISSET(cpu, &cpus)) ++cpu;
  return static_cast<int>(cpu);
}

/// Takes the right to real-time scheduling from the calling thread alone (glibc's wrappers do not offer
/// that).
void give_up_scheduling_rights() {
  __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
  __user_cap_data_struct rights[2];
  REQUIRE(syscall(SYS_capget, &header, rights) == 0);
  for (auto* set : {&rights[0].effective, &rights[0].permitted}) *set &= ~(1U << CAP_SYS_NICE);
  REQUIRE(syscall(SYS_capset, &header, rights) == 0);
}

}  // namespace

TEST_CASE("a thread carries its name for us and for the kernel", "[platform][thread]") {
  ThreadGrant grant;
  const Self self = run_and_look({.name = "front"}, grant);
  CHECK(self.name == "front");
  CHECK(self.kernel_name == "front");
  CHECK(self.policy == SCHED_OTHER);
  CHECK(self.stack_bytes >= ThreadPlan{}.stack_bytes);
  CHECK(grant.refusal.empty());
  CHECK(std::string(current_thread_name()).empty());
  CHECK(run_and_look({.name = "a name beyond fifteen"}, grant).name == "a name beyond f");
}

TEST_CASE("a thread runs where and how its grant says", "[platform][thread]") {
  ThreadGrant grant;
  const int cpu = first_allowed_cpu();
  const Self self = run_and_look({.name = "ingest", .cpu = cpu, .fifo_priority = 20}, grant);
  CHECK(grant.cpu == cpu);
  CHECK(self.num_cpus == 1);
  CHECK(self.priority == grant.fifo_priority);
  CHECK(self.policy == (grant.fifo_priority > 0 ? SCHED_FIFO : SCHED_OTHER));
  CHECK((grant.fifo_priority == 20) == grant.refusal.empty());
}

TEST_CASE("a thread planned as normal does not inherit its creator's priority", "[platform][thread]") {
  ThreadGrant inner;
  Self self;
  Thread outer({.name = "outer", .fifo_priority = 10},
               [&] { self = run_and_look({.name = "inner"}, inner); });
  outer.join();
  CHECK(self.policy == SCHED_OTHER);
  CHECK(inner.fifo_priority == 0);
}

TEST_CASE("without privileges a thread runs as it may and says what was refused", "[platform][thread]") {
  const ThreadPlan plan{.name = "estimate", .cpu = 100'000, .fifo_priority = 70};
  ThreadGrant grant;
  Self self;
  std::thread([&] {
    give_up_scheduling_rights();
    self = run_and_look(plan, grant);
  }).join();
  CHECK(self.policy == SCHED_OTHER);
  CHECK(grant.cpu == -1);
  CHECK(grant.fifo_priority == 0);
  CHECK(describe(plan, grant) ==
        "estimate: any cpu, normal priority (refused: cpu 100000: Invalid argument; FIFO 70: Operation not "
        "permitted)");
}

TEST_CASE("a plan and its grant read as one line", "[platform][thread]") {
  CHECK(describe({.name = "loop"}, {}) == "loop: any cpu, normal priority");
  CHECK(describe({.name = "ingest"}, {.cpu = 0, .fifo_priority = 80, .refusal = {}}) ==
        "ingest: cpu 0, FIFO 80");
}

TEST_CASE("a thread that cannot be made is an error that names it", "[platform][thread]") {
  CHECK_THROWS_AS(Thread({.name = "tiny", .stack_bytes = 1}, [] {}), pago::Error);
  try {
    Thread thread({.name = "tiny", .stack_bytes = 1}, [] {});
  } catch (const pago::Error& error) {
    CHECK(error.where() == "thread tiny");
  }
}

TEST_CASE("a handle that goes waits for its thread, moved or not", "[platform][thread]") {
  std::atomic<int> ended{0};
  const auto body = [&] {
    const std::int64_t begin_ns = monotonic_ns();
    while (monotonic_ns() - begin_ns < 2'000'000) std::this_thread::yield();
    ++ended;
  };
  {
    Thread first({.name = "first"}, body);
    Thread moved = std::move(first);
    moved.join();
    CHECK(ended == 1);
    moved = Thread({.name = "second"}, body);
    CHECK(moved.plan().name == "second");
    moved = Thread({.name = "third"}, body);
    CHECK(ended >= 2);
    const Thread none;
  }
  CHECK(ended == 3);
}
