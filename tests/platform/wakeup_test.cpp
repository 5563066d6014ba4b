// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/wakeup.hpp"

#include <atomic>
#include <csignal>
#include <thread>

#include "support/catch.hpp"

using namespace pago::platform;

namespace {

constexpr std::int64_t kMillisecond_ns = 1'000'000;
/// Longer than any hiccup of a loaded machine: who waits so long was never woken.
constexpr std::int64_t kNoSleepSoLong_ns = 60'000 * kMillisecond_ns;

}  // namespace

TEST_CASE("waiting for something that is true already returns at once", "[platform][wakeup]") {
  Wakeup wakeup;
  int looks = 0;
  CHECK(wakeup.wait_for([&] { return ++looks > 0; }, 0));
  CHECK(looks == 1);
  CHECK(wakeup.wait_until([] { return true; }, -5));
}

TEST_CASE("waiting ends at the deadline and not before it", "[platform][wakeup]") {
  Wakeup wakeup;
  const std::int64_t begin_ns = monotonic_ns();
  CHECK_FALSE(wakeup.wait_for([] { return false; }, 20 * kMillisecond_ns));
  CHECK(monotonic_ns() - begin_ns >= 20 * kMillisecond_ns);
  CHECK_FALSE(wakeup.wait_until([] { return false; }, begin_ns));
  CHECK_FALSE(wakeup.wait_until([] { return false; }, -1));
}

TEST_CASE("a condition that was met is not asked again, so it may take what it found", "[platform][wakeup]") {
  for (int met_at = 1; met_at < 6; ++met_at) {
    Wakeup wakeup;
    int looks = 0;
    const auto ready = [&] {
      wakeup.notify();  // never lets the waiter fall asleep
      return ++looks == met_at;
    };
    CHECK(wakeup.wait_for(ready, kNoSleepSoLong_ns));
    CHECK(looks == met_at);
  }
}

TEST_CASE("a notification without news does not end the wait", "[platform][wakeup]") {
  Wakeup wakeup;
  std::atomic<bool> stop{false};
  std::thread nag([&] {
    while (!stop.load()) wakeup.notify();
  });
  CHECK_FALSE(wakeup.wait_for([] { return false; }, 20 * kMillisecond_ns));
  stop = true;
  nag.join();
}

TEST_CASE("a sleeper wakes for each change, from any of several notifiers", "[platform][wakeup]") {
  constexpr int kNotifiers = 3, kChanges = 3000;
  Wakeup wakeup;
  std::atomic<int> changes{0}, seen{0};
  const auto notifier = [&](int which) {
    // Each waits until the waiter has seen everything, so that it has probably gone to sleep.
    for (int i = which; i < kChanges; i += kNotifiers) {
      while (seen.load(std::memory_order_relaxed) < i) std::this_thread::yield();
      changes.fetch_add(1, std::memory_order_release);
      wakeup.notify();
    }
  };
  std::thread a(notifier, 0), b(notifier, 1), c(notifier, 2);
  bool was_woken = true;
  while (was_woken && seen < kChanges) {
    const int known = seen.load();
    was_woken =
        wakeup.wait_for([&] { return changes.load(std::memory_order_acquire) > known; }, kNoSleepSoLong_ns);
    seen = changes.load();
  }
  seen = kChanges;
  a.join(), b.join(), c.join();
  CHECK(was_woken);
}

TEST_CASE("a signal does not end the wait", "[platform][wakeup]") {
  struct sigaction quiet {
  }, before{};
  quiet.sa_handler = [](int) {};
  sigaction(SIGUSR1, &quiet, &before);
  Wakeup wakeup;
  std::atomic<bool> done{false};
  const pthread_t waiter = pthread_self();
  std::thread disturber([&] {
    while (!done.load()) {
      pthread_kill(waiter, SIGUSR1);
      std::this_thread::yield();
    }
  });
  const std::int64_t begin_ns = monotonic_ns();
  CHECK_FALSE(wakeup.wait_for([] { return false; }, 20 * kMillisecond_ns));
  CHECK(monotonic_ns() - begin_ns >= 20 * kMillisecond_ns);
  done = true;
  disturber.join();
  sigaction(SIGUSR1, &before, nullptr);
}
