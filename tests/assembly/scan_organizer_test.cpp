// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/scan_organizer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/kitti_scan.hpp"
#include "support/new_counter.hpp"
#include "support/scene.hpp"

using namespace pago;

namespace {

constexpr std::uint32_t kCapacity = 140'000;

/// Chosen points of another sweep, in the order of their indices: coordinates, and rings as a driver would
/// know them.
void take_points(const Sweep& from, const std::vector<std::size_t>& indices, Sweep& to) {
  to.reset();
  to.header.num_columns = kScanColumns;
  to.size = static_cast<std::uint32_t>(indices.size());
  for (std::size_t k = 0; k < indices.size(); ++k) {
    const std::size_t i = indices[k];
    to.x_m[k] = from.x_m[i], to.y_m[k] = from.y_m[i], to.z_m[k] = from.z_m[i];
    to.ring[k] = from.ring[i];
  }
}

std::vector<std::size_t> all_of(const Sweep& sweep) {
  std::vector<std::size_t> indices(sweep.size);
  std::iota(indices.begin(), indices.end(), std::size_t{0});
  return indices;
}

/// A KITTI scan with its rings, which its order tells for certain.
void load_certain(const std::filesystem::path& file, ScanOrganizer& organizer, Sweep& sweep) {
  test::load_kitti_points(file, sweep);
  sweep.header.num_columns = kScanColumns;
  REQUIRE(organizer.organize(sweep) == RingSource::kWraps);
}

std::size_t count_near(const Sweep& sweep, const Sweep& whole, const std::vector<std::size_t>& indices) {
  std::size_t near = 0;
  for (std::size_t k = 0; k < indices.size(); ++k)
    near += std::abs(sweep.ring[k] - whole.ring[indices[k]]) <= 1 ? 1U : 0U;
  return near;
}

std::size_t count_cells(const Sweep& sweep) {
  std::size_t cells = 0;
  for (int ring = 0; ring < kNumRings; ++ring)
    for (int column = 0; column < static_cast<int>(sweep.header.num_columns); ++column) {
      const std::int32_t cell = sweep.range_image.at(ring, column);
      if (cell == RangeImage::kEmpty) continue;
      const auto i = static_cast<std::size_t>(cell);
      REQUIRE(i < sweep.size);
      REQUIRE((sweep.ring[i] == ring && sweep.column[i] == column));
      ++cells;
    }
  return cells;
}

/// What a scene shows at 10 or 20 Hz, with the truth about rings and columns.
void load_scene(int columns, Sweep& sweep) {
  test::Scene scene;
  test::ScanOptions options;
  options.columns = columns;
  scene.level_ground().box({6.0, -3.0, 0.0}, {10.0, 3.0, 4.0}).scan(sweep, options);
}

}  // namespace

TEST_CASE("a scan without some of its rings keeps the numbers of the others", "[assembly][organizer]") {
  PAGO_DATA_OR_SKIP(file, "kitti/odometry_00_000000-000015/velodyne/000005.bin");
  Sweep whole(kCapacity), sweep(kCapacity);
  ScanOrganizer organizer(kCapacity);
  load_certain(file, organizer, whole);
  std::uint64_t guessed = 0;
  for (const std::vector<int>& missing : {std::vector{63}, {62, 63}, {0}, {20}, {10, 30, 50}}) {
    std::vector<std::size_t> kept = all_of(whole);
    std::erase_if(
        kept, [&](std::size_t i) { return std::ranges::find(missing, int{whole.ring[i]}) != missing.end(); });
    take_points(whole, kept, sweep);
    INFO("without " << missing.size() << " rings from " << missing[0] << " on");
    CHECK(organizer.organize(sweep) == RingSource::kSegments);
    CHECK(organizer.scans_with_guessed_rings() == ++guessed);
    CHECK(count_near(sweep, whole, kept) == kept.size());
  }
}

TEST_CASE("a scan in another order gets rings by elevation, nearly all within one", "[assembly][organizer]") {
  PAGO_DATA_OR_SKIP(file, "kitti/odometry_00_000000-000015/velodyne/000000.bin");
  Sweep whole(kCapacity), sweep(kCapacity);
  ScanOrganizer organizer(kCapacity);
  load_certain(file, organizer, whole);
  std::vector<std::size_t> order = all_of(whole);
  std::shuffle(order.begin(), order.end(), std::mt19937(5));
  take_points(whole, order, sweep);
  CHECK(organizer.organize(sweep) == RingSource::kElevation);
  CHECK(organizer.scans_with_guessed_rings() == 1);
  CHECK(static_cast<double>(count_near(sweep, whole, order)) > 0.95 * static_cast<double>(order.size()));
}

TEST_CASE("known rings give the cells that found ones give, in any order", "[assembly][organizer]") {
  PAGO_DATA_OR_SKIP(file, "kitti/odometry_00_000000-000015/velodyne/000003.bin");
  Sweep whole(kCapacity), sweep(kCapacity);
  ScanOrganizer organizer(kCapacity);
  load_certain(file, organizer, whole);
  std::vector<std::size_t> order = all_of(whole);
  std::shuffle(order.begin(), order.end(), std::mt19937(6));
  take_points(whole, order, sweep);
  organizer.place_columns(sweep);
  std::size_t different = 0;
  for (std::size_t k = 0; k < order.size(); ++k) {
    REQUIRE(sweep.ring[k] == whole.ring[order[k]]);
    different += sweep.column[k] != whole.column[order[k]] ? 1U : 0U;
  }
  CHECK(different < 10);  // returns of one ring with the very same azimuth may change places
  CHECK(count_cells(sweep) == sweep.size);
  CHECK(organizer.scans_with_guessed_rings() == 0);
}

TEST_CASE("columns follow the head whatever its speed", "[assembly][organizer]") {
  for (const int firings : {1042, 2083}) {
    INFO(firings << " firings");
    Sweep sweep(kCapacity);
    load_scene(firings, sweep);
    const std::vector<std::uint16_t> truth(sweep.column.begin(), sweep.column.begin() + sweep.size);
    for (int ring = 0; ring < kNumRings; ++ring)
      std::fill_n(sweep.range_image.row(ring), firings, RangeImage::kEmpty);
    sweep.header.num_columns =
        static_cast<std::uint32_t>(scan_columns(sweep.header.end_ns - sweep.header.start_ns));
    ScanOrganizer organizer(kCapacity);
    organizer.place_columns(sweep);
    CHECK(count_cells(sweep) == sweep.size);
    const double scale = static_cast<double>(sweep.header.num_columns) / firings;
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      REQUIRE(std::abs((truth[i] + 0.5) * scale - sweep.column[i] - 0.5) < 1.5);
      REQUIRE(std::abs(static_cast<double>(organizer.turn_rev()[i]) - (truth[i] + 0.5) / firings) < 1e-5);
    }
  }
}

TEST_CASE("every rotation from 5 to 20 Hz gets a column per firing and a tenth more at most",
          "[assembly][organizer]") {
  for (std::int64_t rotation_ns = 50'000'000; rotation_ns <= 200'000'000; rotation_ns += 12'345) {
    const auto firings = static_cast<double>(rotation_ns / 48'000);
    REQUIRE(scan_columns(rotation_ns) >= firings);
    REQUIRE(scan_columns(rotation_ns) <= 1.1 * firings + 1.0);
  }
  for (const double factor : {0.97, 0.99, 1.0, 1.01, 1.02})  // KITTI's stamps
    CHECK(scan_columns(static_cast<std::int64_t>(103.6e6 * factor)) == kScanColumns);
  CHECK(scan_columns(250'000'000) == kMaxColumns);
  for (const std::int64_t no_rotation_ns : {-1, 0, 1'000, 39'999'999, 250'000'001})
    CHECK(scan_columns(no_rotation_ns) == kScanColumns);
}

TEST_CASE("points that are no returns stay in place, without coordinates or cell", "[assembly][organizer]") {
  Sweep sweep(kCapacity);
  ScanOrganizer organizer(kCapacity);
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  const Eigen::Vector3f points[] = {{5.0F, 1.0F, -1.0F}, {kNan, 1.0F, 1.0F},  {1.0F, 1.0F, -1e30F},
                                    {0.0F, 0.0F, 3.0F},  {0.0F, 0.0F, 0.0F},  {1e6F, 0.0F, 0.0F},
                                    {-4.0F, 2.0F, 0.5F}, {-4.0F, 2.0F, 0.5F}, {-4.0F, -0.0F, 0.5F}};
  sweep.header.num_columns = kScanColumns;
  for (const Eigen::Vector3f& point : points) {
    sweep.x_m[sweep.size] = point.x(), sweep.y_m[sweep.size] = point.y(), sweep.z_m[sweep.size] = point.z();
    ++sweep.size;
  }
  CHECK(organizer.organize(sweep) == RingSource::kElevation);
  CHECK(count_cells(sweep) == 4);
  for (const std::size_t i : {std::size_t{1}, std::size_t{2}, std::size_t{5}})
    CHECK((sweep.x_m[i] == 0.0F && sweep.y_m[i] == 0.0F && sweep.z_m[i] == 0.0F));
  CHECK(sweep.z_m[3] == 3.0F);
  CHECK(sweep.x_m[8] == -4.0F);
  CHECK(organizer.returns_without_cell() == 0);

  sweep.reset();
  sweep.header.num_columns = kScanColumns;
  organizer.organize(sweep);
  CHECK(count_cells(sweep) == 0);
  CHECK(organizer.turn_rev().empty());
}

TEST_CASE("organizing allocates nothing", "[assembly][organizer]") {
  Sweep scene(kCapacity), sweep(kCapacity);
  load_scene(2083, scene);
  take_points(scene, all_of(scene), sweep);
  ScanOrganizer organizer(kCapacity);
  const std::uint64_t before = test::news_so_far();
  organizer.organize(sweep);
  CHECK(test::news_so_far() == before);
  const Sweep planted(1);
  CHECK(test::news_so_far() > before);
}
