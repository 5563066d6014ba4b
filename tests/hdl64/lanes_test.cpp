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
    FiringLanes plain, fast;
    portable::unpack(slots.get(), plain.raw.data(), plain.intensity.data());
    fastest::unpack(slots.get(), fast.raw.data(), fast.intensity.data());
    for (std::size_t j = 0; j < kLasersPerBlock; ++j) {
      REQUIRE(plain.raw[j] == slots[3 * j] + 256 * slots[3 * j + 1]);
      REQUIRE(plain.intensity[j] == slots[3 * j + 2]);
      REQUIRE(fast.raw[j] == plain.raw[j]);
      REQUIRE(fast.intensity[j] == plain.intensity[j]);
    }
  }
}

TEST_CASE("gaps are closed alike for any pattern of missing returns", "[hdl64][lanes]") {
  std::mt19937 random(8);
  FiringLanes lanes;
  ValidRange valid;
  for (std::size_t i = 0; i < kLasers; ++i) {
    lanes.intensity[i] = static_cast<int>(random() % 256);
    lanes.x_m[i] = static_cast<float>(i);
    lanes.y_m[i] = static_cast<float>(i) + 100.0F;
    lanes.z_m[i] = -static_cast<float>(i);
    valid.ring[i] = static_cast<std::uint8_t>(63 - i);
    valid.first_raw[i] = 10;
    valid.last_raw[i] = 60000;
  }
  for (int round = 0; round < 20000; ++round) {
    const unsigned share = static_cast<unsigned>(round) % 17;  // from none to all
    for (std::size_t i = 0; i < kLasers; ++i)
      lanes.raw[i] = random() % 16 < share ? (i % 2 == 0 ? 10 : 60000) : (i % 2 == 0 ? 9 : 60001);
    FiringReturns plain, fast;
    portable::compact(lanes, valid, plain);
    fastest::compact(lanes, valid, fast);
    REQUIRE(fast.size == plain.size);
    if (share == 0) REQUIRE(plain.size == 0);
    if (share == 16) REQUIRE(plain.size == kLasers);
    bool same = true;
    for (std::size_t n = 0; n < static_cast<std::size_t>(plain.size); ++n)
      same &= fast.x_m[n] == plain.x_m[n] && fast.y_m[n] == plain.y_m[n] && fast.z_m[n] == plain.z_m[n] &&
              fast.intensity[n] == plain.intensity[n] && fast.ring[n] == plain.ring[n] &&
              fast.laser[n] == plain.laser[n];
    REQUIRE(same);
  }
}
