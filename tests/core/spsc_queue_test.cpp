// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/spsc_queue.hpp"

#include <atomic>
#include <boost/lockfree/spsc_queue.hpp>
#include <random>
#include <thread>

#include "support/catch.hpp"

using pago::SpscQueue;

namespace {

/// Starts so close below 2^32 that every test of some length crosses it.
constexpr std::uint32_t kBeforeWrap = 0U - 5U;

/// Several words, so that an element read too early or overwritten too soon shows as one that does not fit
/// together.
struct Element {
  std::uint64_t number = 0, square = 0, inverse = 0;

  static Element of(std::uint64_t n) { return {n, n * n, ~n}; }
  bool is_of(std::uint64_t n) const { return number == n && square == n * n && inverse == ~n; }
};

template <typename Queue>
void push_all(Queue& queue, std::uint64_t count) {
  for (std::uint64_t i = 0; i < count; ++i) {
    while (!queue.try_push(Element::of(i))) std::this_thread::yield();
  }
}

}  // namespace

TEST_CASE("a queue does what boost::lockfree::spsc_queue does, operation by operation",
          "[core][spsc_queue]") {
  const auto capacity = GENERATE(1U, 2U, 8U, 64U);
  const auto first_index = GENERATE(0U, kBeforeWrap);
  const auto seed = GENERATE(range(1U, 6U));
  SpscQueue<std::uint32_t> queue(capacity, first_index);
  boost::lockfree::spsc_queue<std::uint32_t> oracle(capacity);
  std::mt19937 random(seed);
  auto push_percent = random() % 101;  // drifts, so that full and empty are both met often
  for (std::uint32_t i = 0; i < 5'000; ++i) {
    if (i % 100 == 0) push_percent = random() % 101;
    if (random() % 100 < push_percent) {
      REQUIRE(queue.try_push(i) == oracle.push(i));
    } else {
      std::uint32_t value = 1, expected = 1;
      REQUIRE(queue.try_pop(value) == oracle.pop(expected));
      REQUIRE(value == expected);
    }
    REQUIRE(queue.size() == oracle.read_available());
    REQUIRE(queue.capacity() - queue.size() == oracle.write_available());
  }
}

TEST_CASE("a full queue refuses a value and keeps the old ones", "[core][spsc_queue]") {
  SpscQueue<int> queue(4, kBeforeWrap);
  for (int i = 0; i < 4; ++i) CHECK(queue.try_push(i));
  CHECK_FALSE(queue.try_push(99));
  CHECK(queue.size() == 4);
  int value = -1;
  for (int i = 0; i < 4; ++i) {
    CHECK(queue.try_pop(value));
    CHECK(value == i);
  }
}

TEST_CASE("an empty queue leaves the caller's value alone", "[core][spsc_queue]") {
  SpscQueue<int> queue(4);
  int value = 7;
  CHECK_FALSE(queue.try_pop(value));
  CHECK(value == 7);
  CHECK(queue.size() == 0);
}

TEST_CASE("the capacity is rounded up to a power of two and usable in full", "[core][spsc_queue]") {
  for (const auto& [asked, given] :
       {std::pair{0U, 1U}, {1U, 1U}, {2U, 2U}, {5U, 8U}, {64U, 64U}, {65U, 128U}}) {
    SpscQueue<char> queue(asked);
    CHECK(queue.capacity() == given);
    for (std::uint32_t i = 0; i < given; ++i) CHECK(queue.try_push('x'));
    CHECK_FALSE(queue.try_push('x'));
  }
}

TEST_CASE("the two sides write to different cache lines", "[core][spsc_queue]") {
  // Constant part, producer's line, consumer's line; none shared with whatever lies next to the queue.
  CHECK(alignof(SpscQueue<int>) == pago::kCacheLineBytes);
  CHECK(sizeof(SpscQueue<int>) == 3 * pago::kCacheLineBytes);
}

TEST_CASE("two threads exchange every element once, whole and in order", "[core][spsc_queue]") {
  const auto capacity = GENERATE(1U, 2U, 16U, 1024U);
  // At capacity 1 each element costs two turns of the scheduler on a loaded machine.
  const std::uint64_t count = 10'000 + 200 * capacity;
  SpscQueue<Element> queue(capacity, kBeforeWrap);
  std::thread producer([&] { push_all(queue, count); });
  std::uint64_t num_wrong = 0;
  for (std::uint64_t i = 0; i < count; ++i) {
    Element element;
    while (!queue.try_pop(element)) std::this_thread::yield();
    if (!element.is_of(i)) ++num_wrong;
  }
  producer.join();
  CHECK(num_wrong == 0);
  CHECK(queue.size() == 0);
}

TEST_CASE("the size seen by a third thread stays between nothing and the capacity", "[core][spsc_queue]") {
  constexpr std::uint64_t kCount = 10'000;
  SpscQueue<Element> queue(4, kBeforeWrap);
  std::atomic<bool> done{false};
  std::uint32_t largest = 0;
  std::thread observer([&] {
    while (!done.load()) largest = std::max(largest, queue.size());
  });
  std::thread producer([&] { push_all(queue, kCount); });
  for (std::uint64_t i = 0; i < kCount;) {
    Element element;
    if (queue.try_pop(element)) {
      ++i;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  done = true;
  observer.join();
  CHECK(largest <= queue.capacity());
}
