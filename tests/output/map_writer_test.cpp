// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/map_writer.hpp"

#include <algorithm>
#include <fstream>
#include <random>
#include <tuple>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/core/se3.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::output;
using pago::test::contents;
using pago::test::ScratchFolder;

using Row = std::tuple<float, float, float, int, int>;

/// The points of a map's file, sorted; their number must be what its header says.
std::vector<Row> points_of(const std::filesystem::path& file) {
  const std::string ply = contents(file), end = "end_header\n", vertices = "element vertex ";
  const std::size_t start = ply.find(end) + end.size();
  std::vector<Row> rows;
  for (std::size_t at = start; at + kPlyPointBytes <= ply.size(); at += kPlyPointBytes) {
    const PlyPoint p = ply_point(ply.data() + at);
    rows.emplace_back(p.x_m, p.y_m, p.z_m, p.intensity, p.ground);
  }
  CHECK(ply.size() == start + rows.size() * kPlyPointBytes);
  CHECK(std::stoul(ply.substr(ply.find(vertices) + vertices.size())) == rows.size());
  std::sort(rows.begin(), rows.end());
  return rows;
}

void add(MapSweep& sweep, const Eigen::Vector3f& p, float before_s, int intensity, int ground) {
  const std::uint32_t to = sweep.size++;
  sweep.x_m[to] = p.x(), sweep.y_m[to] = p.y(), sweep.z_m[to] = p.z();
  sweep.before_s[to] = before_s;
  sweep.intensity[to] = static_cast<std::uint8_t>(intensity);
  sweep.ground[to] = static_cast<std::uint8_t>(ground);
}

/// A drive along x, there and back, with points all around: the same places are seen again after a while.
std::vector<MapSweep> there_and_back(int sweeps) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> side(-60.0F, 60.0F), height(-2.0F, 8.0F);
  std::vector<MapSweep> drive;
  for (int i = 0; i < sweeps; ++i) {
    MapSweep& sweep = drive.emplace_back(2000);
    const int place = i < sweeps / 2 ? i : sweeps - 1 - i;
    sweep.T_odom_reference.translation().x() = 20.0 * place;
    for (int k = 0; k < 2000; ++k)
      add(sweep, {side(random), side(random), height(random)}, 0.0F, k % 256, k % 2);
  }
  return drive;
}

TEST_CASE("points are moved to one instant and into odom, with intensity and ground flag", "[output][map]") {
  const ScratchFolder scratch;
  MapWriter writer(scratch.path, SavedMapConfig{});
  MapSweep sweep(10);
  sweep.twist[0] = 10.0, sweep.twist[5] = 0.5;
  Vector6d motion;
  motion << 5.0, -3.0, 1.0, 0.1, 0.2, 2.0;
  sweep.T_odom_reference = exp_se3(motion);
  const Eigen::Vector3f seen(20.0F, -7.0F, 1.5F);
  add(sweep, seen, 0.04F, 200, 1);
  add(sweep, seen, -0.03F, 17, 0);
  writer.add(sweep);
  writer.write("map.ply");
  const std::vector<Row> rows = points_of(scratch.path / "map.ply");
  REQUIRE(rows.size() == 2);
  for (const auto& [x_m, y_m, z_m, intensity, ground] : rows) {
    const double before_s = intensity == 200 ? 0.04 : -0.03;
    const Eigen::Vector3d exact =
        sweep.T_odom_reference * exp_se3(-before_s * sweep.twist) * seen.cast<double>();
    CHECK((Eigen::Vector3d(x_m, y_m, z_m) - exact).norm() < 1e-4);
    CHECK(ground == (intensity == 200 ? 1 : 0));
  }
}

TEST_CASE("a map has one point per voxel, the first", "[output][map]") {
  const ScratchFolder scratch;
  MapWriter writer(scratch.path, SavedMapConfig{.voxel_m = 0.5});
  MapSweep sweep(10);
  for (const float x_m : {-0.6F, -0.4F, -0.1F, 0.1F, 0.4F, 0.6F}) add(sweep, {x_m, 0.1F, 0.1F}, 0.0F, 1, 0);
  writer.add(sweep);
  writer.add(sweep);
  CHECK(writer.num_points() == 4);
  CHECK(writer.num_keyframes() == 2);
  writer.write("map.ply");
  const std::vector<Row> rows = points_of(scratch.path / "map.ply");
  REQUIRE(rows.size() == 4);
  CHECK(std::get<0>(rows[1]) == -0.4F);
  CHECK(std::get<0>(rows[2]) == 0.1F);
}

TEST_CASE("places that wait on the disk make the same map in bounded memory", "[output][map]") {
  const ScratchFolder large_folder, small_folder;
  MapWriter large(large_folder.path, SavedMapConfig{.voxel_m = 0.25});
  MapWriter small(small_folder.path, SavedMapConfig{.voxel_m = 0.25, .max_points_in_memory = 10'000});
  for (const MapSweep& sweep : there_and_back(60)) large.add(sweep), small.add(sweep);
  CHECK(std::filesystem::exists(small_folder.path / "map_tiles"));
  CHECK_FALSE(std::filesystem::exists(large_folder.path / "map_tiles"));
  for (int again = 0; again < 2; ++again) {
    large.write("map.ply"), small.write("map.ply");
    const std::vector<Row> rows = points_of(large_folder.path / "map.ply");
    CHECK(rows.size() > 80'000);
    CHECK(rows == points_of(small_folder.path / "map.ply"));
    CHECK(contents(large_folder.path / "map.ply") == contents(small_folder.path / "map.ply"));
  }
}

TEST_CASE("what waits on the disk is gone with the writer, or when odom begins anew", "[output][map]") {
  const ScratchFolder scratch;
  {
    MapWriter writer(scratch.path, SavedMapConfig{.voxel_m = 0.25, .max_points_in_memory = 10'000});
    const std::vector<MapSweep> drive = there_and_back(20);
    for (const MapSweep& sweep : drive) writer.add(sweep);
    writer.clear();
    CHECK_FALSE(std::filesystem::exists(scratch.path / "map_tiles"));
    writer.write("map.ply");
    CHECK(points_of(scratch.path / "map.ply").empty());
    for (const MapSweep& sweep : drive) writer.add(sweep);
    CHECK(std::filesystem::exists(scratch.path / "map_tiles"));
  }
  CHECK_FALSE(std::filesystem::exists(scratch.path / "map_tiles"));
}

TEST_CASE("a map that cannot be written is an Error, tiles that cannot are a complaint", "[output][map]") {
  MapWriter nowhere("no/such/folder", SavedMapConfig{});
  CHECK_THROWS_WITH(nowhere.write("map.ply"), Catch::Matchers::Contains("no/such/folder/map.ply"));

  const ScratchFolder scratch;
  std::ofstream(scratch.path / "map_tiles") << "a file is in the way";
  MapWriter writer(scratch.path, SavedMapConfig{.voxel_m = 0.25, .max_points_in_memory = 10'000});
  for (const MapSweep& sweep : there_and_back(20)) writer.add(sweep);
  CHECK_THAT(writer.complaint(), Catch::Matchers::Contains("missing from the map"));
  writer.write("map.ply");
  CHECK(points_of(scratch.path / "map.ply").size() == writer.num_points());
}

}  // namespace
