// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/seqlock.hpp"

#include <new>
#include <thread>
#include <vector>

#include "support/catch.hpp"

using namespace pago;

namespace {

/// Whole when all its words agree.
struct Wide {
  std::array<std::uint64_t, 40> words{};
  static Wide of(std::uint64_t n) {
    Wide wide;
    for (std::size_t i = 0; i < wide.words.size(); ++i) wide.words[i] = n * (i + 1);
    return wide;
  }
  bool is_whole() const {
    for (std::size_t i = 0; i < words.size(); ++i)
      if (words[i] != words[0] * (i + 1)) return false;
    return true;
  }
};

}  // namespace

TEST_CASE("a slot holds nothing, then the newest value", "[core][seqlock]") {
  Seqlock<Wide> slot;
  Wide seen;
  CHECK_FALSE(slot.try_load(seen));
  CHECK(slot.count() == 0);
  slot.store(Wide::of(7));
  slot.store(Wide::of(8));
  REQUIRE(slot.try_load(seen));
  CHECK(seen.words == Wide::of(8).words);
  CHECK(slot.count() == 2);
}

TEST_CASE("zero bytes are a slot that holds nothing yet", "[core][seqlock]") {
  alignas(Seqlock<Wide>) std::array<unsigned char, sizeof(Seqlock<Wide>)> memory{};
  const auto* slot = std::launder(reinterpret_cast<const Seqlock<Wide>*>(memory.data()));
  Wide seen;
  CHECK_FALSE(slot->try_load(seen));
}

TEST_CASE("readers see whole values, each at least as new as the one before", "[core][seqlock]") {
  constexpr std::uint64_t kStores = 100'000, kLoads = 100;
  Seqlock<Wide> slot;
  std::atomic<std::uint64_t> torn{0}, backwards{0}, loads{0};
  std::atomic<bool> is_over{false};
  std::vector<std::thread> readers;
  for (int i = 0; i < 2; ++i) {
    readers.emplace_back([&] {
      Wide seen;
      for (std::uint64_t last = 0; !is_over; std::this_thread::yield()) {
        if (!slot.try_load(seen)) continue;
        ++loads;
        torn += seen.is_whole() ? 0U : 1U;
        backwards += seen.words[0] >= last ? 0U : 1U;
        last = seen.words[0];
      }
    });
  }
  // However the machine shares its cores out, the readers get their turn.
  for (std::uint64_t n = 1; n <= kStores || loads < kLoads; ++n) {
    slot.store(Wide::of(n));
    if (n > kStores) std::this_thread::yield();
  }
  is_over = true;
  for (std::thread& reader : readers) reader.join();
  CHECK(torn == 0);
  CHECK(backwards == 0);
  CHECK(loads >= kLoads);
}
