// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/sweep_ring.hpp"

#include <set>

#include "support/catch.hpp"

using namespace pago;

TEST_CASE("a ring hands out each of its sweeps, and then none", "[assembly][sweep_ring]") {
  SweepRing ring(3, 1000);
  std::set<Sweep*> out;
  for (int i = 0; i < 3; ++i) out.insert(ring.try_acquire());
  CHECK(out.size() == 3);
  CHECK(out.count(nullptr) == 0);
  CHECK(ring.try_acquire() == nullptr);
  CHECK(ring.in_flight() == 3);
  for (const Sweep* sweep : out) CHECK(sweep->capacity() == 1000);
}

TEST_CASE("sweeps go round in order", "[assembly][sweep_ring]") {
  SweepRing ring(2, 64);
  Sweep* const a = ring.try_acquire();
  Sweep* const b = ring.try_acquire();
  for (int lap = 0; lap < 5; ++lap) {
    ring.release(a);
    CHECK(ring.try_acquire() == a);
    CHECK(ring.try_acquire() == nullptr);
    ring.release(b);
    CHECK(ring.try_acquire() == b);
  }
  CHECK(ring.acquired() == 12);
  CHECK(ring.in_flight() == 2);
}

TEST_CASE("a sweep comes out of the ring empty, but for the columns that it says", "[assembly][sweep_ring]") {
  SweepRing ring(1, 64);
  Sweep* sweep = ring.try_acquire();
  sweep->size = 7;
  sweep->header.num_columns = 2000;
  sweep->header.flags = kOverfull;
  sweep->range_image.at(5, 1999) = 3;
  sweep->range_image.at(63, 2000 + kColumnMargin - 1) = 4;
  sweep->range_image.at(0, -kColumnMargin) = 5;
  ring.release(sweep);
  sweep = ring.try_acquire();
  CHECK(sweep->size == 0);
  CHECK(sweep->header.num_columns == 0);
  CHECK(sweep->header.flags == 0);
  CHECK(sweep->stale_columns == 2000);
  ring.release(sweep);
  CHECK(ring.try_acquire() == sweep);  // it was never filled
  CHECK(sweep->stale_columns == 2000);
  sweep->clear_stale_columns();
  CHECK(sweep->stale_columns == 0);
  int taken = 0;
  for (int ring_index = 0; ring_index < kNumRings; ++ring_index)
    for (int column = -kColumnMargin; column < kMaxColumns + kColumnMargin; ++column)
      taken += sweep->range_image.at(ring_index, column) != RangeImage::kEmpty;
  CHECK(taken == 0);
}
