// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/hdl64/lanes.hpp"

#include <memory>
#include <random>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::hdl64;

// Where the build has no vector version, these compare the portable one with itself.

TEST_CASE("slots are taken apart alike, without reading past the packet", "[hdl64][lanes]") {
  std::mt19937 random(7);
  // The packet's last block: 96 bytes of slots and the trailer of 6, on the heap to the byte, so that the
  // address sanitizer sees a read beyond.
  const auto slots = std::make_unique<std::uint8_t[]>(102);
  for (int round = 0; round < 1000; ++round) {
    for (std::size_t i = 0; i < 102; ++i) slots[i] = static_cast<std::uint8_t>(random());
    const std::int32_t bits = round % 2 == 0 ? 0xFFFF : 0xFFF8;
    PacketLanes plain, fast;
    portable::unpack(slots.get(), bits, plain.raw.data(), plain.intensity.data());
    fastest::unpack(slots.get(), bits, fast.raw.data(), fast.intensity.data());
    for (std::size_t j = 0; j < kLasersPerBlock; ++j) {
      REQUIRE(plain.raw[j] == ((slots[3 * j] + 256 * slots[3 * j + 1]) & bits));
      REQUIRE(plain.intensity[j] == slots[3 * j + 2]);
      REQUIRE(fast.raw[j] == plain.raw[j]);
      REQUIRE(fast.intensity[j] == plain.intensity[j]);
    }
  }
}

TEST_CASE("lanes within their ranges are found alike, both ends included", "[hdl64][lanes]") {
  std::mt19937 random(8);
  alignas(64) RawLanes raw, first, last;
  for (int round = 0; round < 20000; ++round) {
    const auto share = static_cast<unsigned>(round) % 17;  // from none to all
    for (std::size_t i = 0; i < kLasers; ++i) {
      first[i] = 10 + static_cast<std::int32_t>(i);
      last[i] = 60000 - static_cast<std::int32_t>(i);
      const bool inside = random() % 16 < share;
      raw[i] = i % 2 == 0 ? first[i] - (inside ? 0 : 1) : last[i] + (inside ? 0 : 1);
    }
    const std::uint64_t set = portable::in_range(raw, first, last);
    if (share == 0) REQUIRE(set == 0);
    if (share == 16) REQUIRE(set == ~std::uint64_t{0});
    REQUIRE(fastest::in_range(raw, first, last) == set);
  }
}
