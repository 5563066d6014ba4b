// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/range_image.hpp"

#include <set>

#include "support/catch.hpp"

using pago::RangeImage;

TEST_CASE("every cell, margins included, is its own", "[core][range_image]") {
  RangeImage image;
  std::int32_t next = 0;
  for (int ring = 0; ring < pago::kNumRings; ++ring) {
    for (int column = -pago::kColumnMargin; column < pago::kMaxColumns + pago::kColumnMargin; ++column) {
      REQUIRE(image.at(ring, column) == RangeImage::kEmpty);
      image.at(ring, column) = next++;
    }
  }
  next = 0;
  for (int ring = 0; ring < pago::kNumRings; ++ring) {
    for (int column = -pago::kColumnMargin; column < pago::kMaxColumns + pago::kColumnMargin; ++column) {
      REQUIRE(image.at(ring, column) == next);
      REQUIRE(image.row(ring)[column] == next++);
    }
  }
}

TEST_CASE("clearing empties the used columns and both margins beside them", "[core][range_image]") {
  RangeImage image;
  constexpr int kUsed = 2083;
  for (int ring = 0; ring < pago::kNumRings; ++ring) {
    for (int column = -pago::kColumnMargin; column < kUsed + pago::kColumnMargin; ++column) {
      image.at(ring, column) = 1;
    }
    image.at(ring, kUsed + pago::kColumnMargin) = 2;
  }
  image.clear(kUsed);
  for (int ring = 0; ring < pago::kNumRings; ++ring) {
    for (int column = -pago::kColumnMargin; column < kUsed + pago::kColumnMargin; ++column) {
      REQUIRE(image.at(ring, column) == RangeImage::kEmpty);
    }
    REQUIRE(image.at(ring, kUsed + pago::kColumnMargin) == 2);
  }
}

TEST_CASE("a part of a ring is emptied, and nothing beside it", "[core][range_image]") {
  RangeImage image;
  for (int ring = 0; ring < pago::kNumRings; ++ring)
    for (int column = -pago::kColumnMargin; column < pago::kMaxColumns + pago::kColumnMargin; ++column)
      image.at(ring, column) = 1;
  image.clear(7, -pago::kColumnMargin, 20);
  image.clear(7, 30, 30);
  image.clear(7, 50, 40);
  for (int ring = 0; ring < pago::kNumRings; ++ring)
    for (int column = -pago::kColumnMargin; column < pago::kMaxColumns + pago::kColumnMargin; ++column)
      REQUIRE((image.at(ring, column) == RangeImage::kEmpty) == (ring == 7 && column < 20));
}

TEST_CASE("the cells of one column spread over the first-level cache", "[core][range_image]") {
  // 64 sets of 64 bytes: an odd stride in cache lines gives each of the 64 rings another set.
  RangeImage image;
  std::set<std::uintptr_t> sets;
  for (int ring = 0; ring < pago::kNumRings; ++ring) {
    sets.insert(reinterpret_cast<std::uintptr_t>(&image.at(ring, 1000)) / 64 % 64);
  }
  CHECK(sets.size() == 64);
}
