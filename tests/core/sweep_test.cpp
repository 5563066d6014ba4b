// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/sweep.hpp"

#include "support/catch.hpp"

using namespace pago;

TEST_CASE("a sweep has room for its returns in every array", "[core][sweep]") {
  const Sweep sweep(1000);
  CHECK(sweep.capacity() == 1000);
  for (const std::size_t size : {sweep.x_m.size(), sweep.y_m.size(), sweep.z_m.size(), sweep.intensity.size(),
                                 sweep.ring.size(), sweep.column.size(), sweep.time_offset_ns.size(),
                                 sweep.label.size(), sweep.ground.size(), sweep.cluster.size()}) {
    CHECK(size == 1000);
  }
}

TEST_CASE("a sweep that was reset is as good as new and has kept its memory", "[core][sweep]") {
  Sweep sweep(100);
  const float* const memory = sweep.x_m.data();
  sweep.header.num_columns = 2083;
  sweep.header.flags = kPartialEnd;
  sweep.size = 50;
  sweep.range_image.at(63, 2082) = 49;
  sweep.range_image.at(0, -1) = 3;
  sweep.features.edges.push_back(1);
  sweep.features.sharp_edges.push_back(1);
  sweep.features.planars.push_back(1);
  sweep.features.flat_planars.push_back(1);
  sweep.estimate.health = Health::kLost;
  sweep.time_of(StageId::kGround).end_ns = 5;
  sweep.reset();
  CHECK(sweep.header.flags == 0);
  CHECK(sweep.header.num_columns == 0);
  CHECK(sweep.size == 0);
  CHECK(sweep.range_image.at(63, 2082) == RangeImage::kEmpty);
  CHECK(sweep.range_image.at(0, -1) == RangeImage::kEmpty);
  CHECK(sweep.features.edges.empty());
  CHECK(sweep.features.sharp_edges.empty());
  CHECK(sweep.features.planars.empty());
  CHECK(sweep.features.flat_planars.empty());
  CHECK(sweep.estimate.health == Health::kInit);
  CHECK(sweep.time_of(StageId::kGround).end_ns == 0);
  CHECK(sweep.x_m.data() == memory);
  CHECK(sweep.stale_columns == 0);
}

TEST_CASE("a recycled sweep is empty, and says which columns of its range image are not", "[core][sweep]") {
  Sweep sweep(100);
  sweep.header.num_columns = 2083;
  sweep.size = 50;
  sweep.range_image.at(63, 2082) = 49;
  sweep.recycle();
  CHECK(sweep.header.num_columns == 0);
  CHECK(sweep.size == 0);
  CHECK(sweep.stale_columns == 2083);
  CHECK(sweep.range_image.at(63, 2082) == 49);
  sweep.header.num_columns = 1000;  // filled with less, and nobody emptied the rest
  sweep.recycle();
  CHECK(sweep.stale_columns == 2083);
  sweep.reset();
  CHECK(sweep.stale_columns == 0);
  CHECK(sweep.range_image.at(63, 2082) == RangeImage::kEmpty);
}

TEST_CASE("partial and superseded sweeps get no pose, incomplete ones do", "[core][sweep]") {
  SweepHeader header;
  CHECK(header.is_posed());
  for (const auto flag : {kIncomplete, kAfterGap, kOverfull, kCompensated}) {
    header.flags = flag;
    CHECK(header.has(flag));
    CHECK(header.is_posed());
  }
  for (const auto flag : {kPartialStart, kPartialEnd, kSuperseded}) {
    header.flags = flag | kIncomplete;
    CHECK_FALSE(header.is_posed());
  }
}
