// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The queue under ThreadSanitizer with one of its four memory orders weakened to relaxed (PAGO_MUTANT names
// it, "none" leaves all right). On x86 the weakened queue still works, so only a checker of the memory model
// can tell; if it did not, a clean run of the real queue would prove nothing. tests/core/CMakeLists.txt
// demands a race report for each mutant and none for the original.

#include <cstdio>
#include <string_view>
#include <thread>

#include "pago/core/spsc_queue.hpp"

namespace {

constexpr std::memory_order order_of(std::string_view site, std::memory_order right) {
  return site == PAGO_MUTANT ? std::memory_order_relaxed : right;
}

struct MutantOrders {
  using Right = pago::SpscOrders;
  static constexpr auto kPublishElement = order_of("publish_element", Right::kPublishElement);
  static constexpr auto kObserveElement = order_of("observe_element", Right::kObserveElement);
  static constexpr auto kPublishFree = order_of("publish_free", Right::kPublishFree);
  static constexpr auto kObserveFree = order_of("observe_free", Right::kObserveFree);
};

constexpr int kCount = 20'000;

}  // namespace

int main() {
  // So small that it is full and empty all the time: every hand-over in both directions is exercised.
  pago::SpscQueue<int, MutantOrders> queue(2);
  std::thread producer([&] {
    for (int i = 0; i < kCount; ++i) {
      while (!queue.try_push(i)) std::this_thread::yield();
    }
  });
  int num_wrong = 0;
  for (int i = 0; i < kCount; ++i) {
    int value = -1;
    while (!queue.try_pop(value)) std::this_thread::yield();
    num_wrong += value == i ? 0 : 1;
  }
  producer.join();
  std::printf("%s: %d of %d elements wrong\n", PAGO_MUTANT, num_wrong, kCount);
  return num_wrong == 0 ? 0 : 1;
}
