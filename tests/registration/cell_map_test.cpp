// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/cell_map.hpp"

#include <Eigen/Eigenvalues>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "support/catch.hpp"

using namespace pago;
using namespace pago::registration;

namespace {

struct Cloud {
  Eigen::Vector3d draw(double size) {
    return size * Eigen::Vector3d(uniform(random), uniform(random), uniform(random));
  }
  std::mt19937 random{3};
  std::uniform_real_distribution<double> uniform{-1.0, 1.0};
};

std::tuple<int, int, int> cell_of(const Eigen::Vector3d& p) {
  const auto index = [](double x) { return static_cast<int>(std::floor(x)); };
  return {index(p.x()), index(p.y()), index(p.z())};
}

/// A patch of the plane through (x, y, z) with the normal given, far from the origin as drives get.
void insert_patch(const Eigen::Vector3d& centre, const Eigen::Vector3d& normal, int count, CellMap& map) {
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d offset = cloud.draw(0.45);
    map.insert(centre + offset - normal * normal.dot(offset), 0);
  }
}

}  // namespace

TEST_CASE("a cell's plane is that of its points, far from the origin too", "[registration][cells]") {
  CellMap map({}, 100);
  const Eigen::Vector3d centre(12345.5, -6543.5, 321.5),
      normal = Eigen::Vector3d(0.2, -0.1, 1.0).normalized();
  insert_patch(centre, normal, 25, map);
  Eigen::Vector3f offset;
  const Cell* cell = map.find_shape(centre + 0.1 * normal, 0, offset);
  REQUIRE(cell != nullptr);
  REQUIRE(std::abs(static_cast<double>(cell->axis.dot(normal.cast<float>()))) == Approx(1.0).margin(1e-5));
  REQUIRE(std::abs(cell->axis.dot(offset)) == Approx(0.1F).margin(1e-4));
  REQUIRE(cell->thickness_m2 < 1e-6F);
  REQUIRE(map.find_shape(centre, 1, offset) == nullptr);  // the other class has its own cells
}

TEST_CASE("mean and scatter are those of all points of the cell, up to the limit", "[registration][cells]") {
  CellMapOptions options;
  options.max_points = 1000;
  options.min_points = 3;
  options.max_flatness = 1e9, options.max_thickness_m = 1e9,
  options.min_width_m = 0.0;  // everything has a shape
  CellMap map(options, 1000);
  Cloud cloud;
  std::map<std::tuple<int, int, int>, std::vector<Eigen::Vector3d>> oracle;
  for (int i = 0; i < 20'000; ++i) {
    const Eigen::Vector3d p = cloud.draw(4.0).cwiseProduct(Eigen::Vector3d(1.0, 0.7, 0.4));
    map.insert(p, 0);
    oracle[cell_of(p)].push_back(p);
  }
  REQUIRE(map.size() == oracle.size());
  for (const auto& [at, points] : oracle) {
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : points) mean += p / static_cast<double>(points.size());
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    for (const Eigen::Vector3d& p : points)
      covariance += (p - mean) * (p - mean).transpose() / static_cast<double>(points.size());
    Eigen::Vector3f offset;
    const Cell* cell = map.find_shape(mean, 0, offset);
    REQUIRE(cell != nullptr);
    REQUIRE(offset.norm() < 1e-5F);
    const double least = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0];
    REQUIRE(static_cast<double>(cell->thickness_m2) == Approx(least).margin(1e-5));
  }
}

TEST_CASE("the oldest points count, few make no plane, and rough ones neither", "[registration][cells]") {
  CellMapOptions options;
  options.max_points = 10;
  CellMap map(options, 100);
  Eigen::Vector3f offset;
  const Eigen::Vector3d here(0.5, 0.5, 0.5);
  insert_patch(here, Eigen::Vector3d::UnitZ(), 5, map);
  REQUIRE(map.find_shape(here, 0, offset) == nullptr);
  insert_patch(here, Eigen::Vector3d::UnitZ(), 5, map);
  REQUIRE(map.find_shape(here, 0, offset) != nullptr);
  insert_patch(here + 0.3 * Eigen::Vector3d::UnitZ(), Eigen::Vector3d::UnitZ(), 30, map);
  REQUIRE(std::abs(map.find_shape(here, 0, offset)->axis.z()) == Approx(1.0F));
  REQUIRE(map.find_shape(here, 0, offset)->thickness_m2 < 1e-6F);

  Cloud cloud;
  for (int i = 0; i < 30; ++i) map.insert(Eigen::Vector3d(5.5, 5.5, 5.5) + cloud.draw(0.5), 0);
  REQUIRE(map.find_shape({5.5, 5.5, 5.5}, 0, offset) == nullptr);
}

TEST_CASE("far cells are given up over a number of calls, and near ones are all still found",
          "[registration][cells]") {
  CellMap map({}, 5000);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) map.insert({x + 0.5, y + 0.5, 0.5}, 0);
  REQUIRE(map.size() == 1600);
  for (int call = 0; call < 32; ++call) map.prune({0.0, 0.0, 0.0}, 20.0, map.num_slots() / 16);
  std::uint32_t near = 0;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y) near += x * x + y * y <= 400 ? 1U : 0U;
  REQUIRE(map.size() == near);
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 40; ++y)
      if (x * x + y * y <= 400) map.insert({x + 0.5, y + 0.5, 0.5}, 0);
  REQUIRE(map.size() == near);  // nobody was lost: inserting them again makes no new cell
}

TEST_CASE("a full map leaves points out and counts them, nonsense is left out", "[registration][cells]") {
  CellMap map({}, 10);
  for (int x = 0; x < 15; ++x) map.insert({x + 0.5, 0.5, 0.5}, 0);
  REQUIRE(map.size() == 10);
  REQUIRE(map.left_out() == 5);
  CellMap other({}, 10);
  other.insert({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0}, 0);
  other.insert({1e12, 0.0, 0.0}, 0);
  REQUIRE(other.size() == 0);
}
