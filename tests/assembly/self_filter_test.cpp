// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/self_filter.hpp"

#include <numbers>

#include "assembly/ingest_rig.hpp"
#include "pago/assembly/scan_organizer.hpp"
#include "support/catch.hpp"

using namespace pago;

namespace {

/// A car 4 m long and 2 m wide with the sensor over its middle, 1.8 m up, 0.2 m above the roof.
constexpr VehicleConfig kCar{.front_m = 2.0, .rear_m = 2.0, .left_m = 1.0, .right_m = 1.0, .top_m = 1.6};
Mount on_roof() {
  Mount mount;
  mount.height_m = 1.8;
  return mount;
}

hdl64::FiringReturns firing(std::initializer_list<Eigen::Vector3f> points) {
  hdl64::FiringReturns returns{};
  std::size_t i = 10;  // lasers from this one on
  for (const Eigen::Vector3f& p : points) {
    returns.valid |= std::uint64_t{1} << i;
    returns.x_m[i] = p.x(), returns.y_m[i] = p.y(), returns.z_m[i] = p.z();
    ++i;
  }
  return returns;
}

}  // namespace

TEST_CASE("without a box nothing is the vehicle's own", "[assembly][self_filter]") {
  CHECK_FALSE(SelfFilter().has_box());
  CHECK_FALSE(SelfFilter(VehicleConfig{}, on_roof()).has_box());
  CHECK_FALSE(SelfFilter().is_own(0.1F, 0.1F, 0.1F));
}

TEST_CASE("the vehicle's own returns are taken out and the others stay as they are",
          "[assembly][self_filter]") {
  const SelfFilter filter(kCar, on_roof());
  REQUIRE(filter.has_box());
  // Bonnet; road ahead; a man beside the door; a wheel's mirror image; above the roof.
  hdl64::FiringReturns returns = firing({{1.5F, 0.5F, -1.0F},
                                         {5.0F, 0.0F, -1.8F},
                                         {0.0F, 1.2F, -1.0F},
                                         {1.0F, 0.0F, -2.5F},
                                         {0.0F, 0.0F, 0.5F}});
  CHECK(filter.remove_own(returns) == 2);
  CHECK(returns.valid == (1U << 11U | 1U << 12U | 1U << 14U));
  CHECK(returns.x_m[11] == 5.0F);
  CHECK(filter.remove_own(returns) == 0);
}

TEST_CASE("the box turns with the mount", "[assembly][self_filter]") {
  Mount mount = on_roof();
  SECTION("a sensor turned a quarter to the left sees the car's front at its right") {
    mount.yaw_rad = std::numbers::pi / 2.0;
    const SelfFilter filter(kCar, mount);
    CHECK(filter.is_own(0.0F, -1.5F, -1.0F));
    CHECK_FALSE(filter.is_own(1.5F, 0.0F, -1.0F));
  }
  SECTION("a sensor upside down sees it above") {
    mount.roll_rad = std::numbers::pi;
    const SelfFilter filter(kCar, mount);
    CHECK(filter.is_own(1.5F, 0.0F, 1.0F));
    CHECK_FALSE(filter.is_own(1.5F, 0.0F, -1.0F));
  }
}

TEST_CASE("from packets, own returns are counted and reach no sweep", "[assembly][self_filter]") {
  // Every laser of the stream sees 8 m, level and all around: a room inside a very large vehicle.
  const VehicleConfig hall{.front_m = 5.0, .rear_m = 20.0, .left_m = 20.0, .right_m = 20.0, .top_m = 5.0};
  test::Collector collector(3);
  PacketIngest ingest({}, {}, test::plain_calibration(), collector, SelfFilter(hall, on_roof()));
  const test::PacketStream stream;
  for (int i = 0; i < 694; ++i) {
    const test::PacketBytes bytes = stream.packet(i);
    ingest.push({.payload = bytes, .arrival_ns = stream.arrival_ns(i)});
  }
  ingest.finish();
  std::uint64_t kept = 0;
  for (const auto& sweep : collector.sweeps) kept += sweep.size;
  CHECK(kept + ingest.self_hits() == 694ULL * 6 * 64);
  // Two rotations. Ahead of 5 m: a sector of 2 acos(5 / 8).
  CHECK(static_cast<double>(kept) / (694.0 * 6 * 64) ==
        Approx(std::acos(5.0 / 8.0) / std::numbers::pi).margin(0.005));
}

TEST_CASE("in scans, own points become none and stay in their places", "[assembly][self_filter]") {
  Sweep sweep(3);
  sweep.header.num_columns = 100;
  sweep.size = 3;
  const std::array<Eigen::Vector3f, 3> points{
      {{1.5F, 0.5F, -1.0F}, {5.0F, 0.0F, -1.8F}, {-1.0F, 0.1F, -1.0F}}};
  for (std::size_t i = 0; i < 3; ++i)
    sweep.x_m[i] = points[i].x(), sweep.y_m[i] = points[i].y(), sweep.z_m[i] = points[i].z();
  ScanOrganizer organizer(3, SelfFilter(kCar, on_roof()));
  organizer.organize(sweep);
  CHECK(organizer.self_hits() == 2);
  CHECK(sweep.size == 3);
  CHECK(sweep.x_m[0] == 0.0F);
  CHECK(sweep.x_m[1] == 5.0F);
  CHECK(sweep.x_m[2] == 0.0F);
}
