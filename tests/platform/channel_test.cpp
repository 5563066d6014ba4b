// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/platform/channel.hpp"

#include <random>
#include <thread>

#include "support/catch.hpp"

using namespace pago::platform;

namespace {

/// Longer than any hiccup of a loaded machine: a wait that runs into it has lost its wake-up.
constexpr std::int64_t kNever_ns = 60'000'000'000;

struct Element {
  std::uint64_t number = 0;
  std::uint64_t square = 0;  // tells torn elements
};

/// Work of random length, so that either side is sometimes ahead, sometimes asleep, sometimes just about to
/// be.
void dawdle(std::mt19937& random) {
  if (random() % 8 == 0) std::this_thread::yield();
  for (auto n = random() % 200; n > 0; --n) {
    std::atomic_signal_fence(std::memory_order_seq_cst);
  }
}

}  // namespace

TEST_CASE("a channel is a queue whose ends may wait", "[platform][channel]") {
  Channel<int> channel(3);
  REQUIRE(channel.capacity() == 4);
  int value = -1;
  CHECK_FALSE(channel.try_pop(value));
  CHECK_FALSE(channel.pop_wait(value, 1'000'000));
  CHECK(value == -1);
  for (int i = 0; i < 4; ++i) CHECK(channel.push_wait(i, kNever_ns));
  CHECK_FALSE(channel.try_push(9));
  CHECK_FALSE(channel.push_wait(9, 1'000'000));
  CHECK(channel.size() == 4);
  for (int i = 0; i < 4; ++i) {
    CHECK(channel.pop_wait(value, kNever_ns));
    CHECK(value == i);
  }
  CHECK(channel.size() == 0);
}

TEST_CASE("two threads that sleep at both ends lose no element and no wake-up", "[platform][channel]") {
  const auto capacity = GENERATE(1U, 2U, 8U, 256U);
  constexpr std::uint64_t kCount = 20'000;
  Channel<Element> channel(capacity);
  bool has_pushed_all = true;
  std::thread producer([&] {
    std::mt19937 random(1);
    for (std::uint64_t i = 1; i <= kCount && has_pushed_all; ++i) {
      has_pushed_all = channel.push_wait({i, i * i}, kNever_ns);
      dawdle(random);
    }
  });
  std::mt19937 random(2);
  std::uint64_t next = 1;
  Element element;
  for (; next <= kCount && channel.pop_wait(element, kNever_ns); ++next) {
    if (element.number != next || element.square != next * next) break;
    dawdle(random);
  }
  CHECK(next == kCount + 1);
  while (channel.try_pop(element)) {
  }
  producer.join();
  CHECK(has_pushed_all);
  CHECK(channel.size() == 0);
}

TEST_CASE("elements that go round through two channels sleep at every step", "[platform][channel]") {
  Channel<int> there(1), back(1);
  constexpr int kRounds = 5'000;
  std::thread echo([&] {
    int value = 0;
    for (int i = 0; i < kRounds && there.pop_wait(value, kNever_ns); ++i)
      back.push_wait(value + 1, kNever_ns);
  });
  int value = 0;
  bool is_alive = true;
  for (int i = 0; i < kRounds && is_alive; ++i) {
    is_alive = there.push_wait(value, kNever_ns) && back.pop_wait(value, kNever_ns);
  }
  CHECK(is_alive);
  CHECK(value == kRounds);
  echo.join();
}
