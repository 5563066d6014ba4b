// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "messages.hpp"
#include "pago/config/load.hpp"
#include "support/catch.hpp"

namespace pago {
namespace {

std::string complaint_of(const Config& config) {
  return test::complaint_of([&] { validate(config); });
}

TEST_CASE("the defaults are valid", "[config][validate]") {
  CHECK(complaint_of({}) == "");
}

TEST_CASE("a field that code set out of its range is refused", "[config][validate]") {
  Config config;
  config.mount.height_m = std::nan("");
  CHECK(complaint_of(config) == "configuration: mount.height_m must be a number from 0.1 to 10, is nan");
  config = {};
  config.hdl64.vertical_offset = static_cast<VerticalOffset>(9);
  CHECK(complaint_of(config).find("hdl64.vertical_offset must be one of") != std::string::npos);
}

TEST_CASE("settings that contradict each other are refused with both values", "[config][validate]") {
  Config config;
  config.hdl64.min_range_m = 10.0;
  config.hdl64.max_range_m = 5.0;
  CHECK(complaint_of(config) ==
        "configuration: the sensor's nearest range must be below its farthest (hdl64.min_range_m is 10.0, "
        "hdl64.max_range_m is 5.0)");
}

TEST_CASE("every rule refuses what breaks it", "[config][validate]") {
  const auto broken_by = [](void (*change)(Config&)) {
    Config config;
    change(config);
    return complaint_of(config);
  };
  using test::contains;
  CHECK(contains(
      broken_by([](Config& c) { c.ground.patchwork.min_range_m = c.ground.patchwork.max_range_m = 9.0; }),
      "must begin before they end (ground.patchwork.min_range_m is 9.0"));
  CHECK(
      contains(broken_by([](Config& c) { c.ground.patchwork.zone_rings[2] = 3.5; }), "[2.0, 4.0, 3.5, 4.0]"));
  CHECK(contains(broken_by([](Config& c) { c.ground.patchwork.zone_sectors[0] = 16.1; }), "whole numbers"));
  CHECK(contains(broken_by([](Config& c) {
                   c.ground.patchwork_hdl64.min_range_m = 15.0, c.ground.patchwork_hdl64.max_range_m = 5.0;
                 }),
                 "ground.patchwork_hdl64.max_range_m is 5.0"));
  CHECK(contains(broken_by([](Config& c) { c.ground.patchwork_hdl64.zone_rings[0] = 1.5; }),
                 "ground.patchwork_hdl64.zone_rings is"));
  CHECK(contains(
      broken_by([](Config& c) { c.ground.patchworkpp.min_range_m = c.ground.patchworkpp.max_range_m = 8.0; }),
      "ground.patchworkpp.max_range_m is 8.0"));
  CHECK(contains(broken_by([](Config& c) { c.ground.patchworkpp.zone_sectors[3] = 3.2; }),
                 "ground.patchworkpp.zone_sectors is"));
  CHECK(contains(
      broken_by([](Config& c) { c.ground.linefit.min_range_m = 2.0, c.ground.linefit.max_range_m = 1.0; }),
      "begin before they end (ground.linefit.min_range_m is 2.0"));
  CHECK(contains(
      broken_by([](Config& c) { c.ground.cascaded.min_range_m = 20.0, c.ground.cascaded.max_range_m = 5.0; }),
      "begin before they end (ground.cascaded.min_range_m is 20.0"));
  CHECK(contains(broken_by([](Config& c) { c.features.clustering.min_points_tall = 31; }), "is 31"));
  CHECK(contains(broken_by([](Config& c) { c.features.edges_per_sector = 1; }),
                 "features.edges_per_sector is 1"));
}

}  // namespace
}  // namespace pago
