// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/mapping/laser_offsets.hpp"

#include <random>

#include "pago/core/units.hpp"
#include "src/mapping/local_map.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::mapping;

namespace {

/// A hall of 40 x 12 x 5 m around the sensor, seen by 64 lasers that are off by what they are.
struct Hall {
  explicit Hall(unsigned seed) : random(seed) {
    std::normal_distribution<double> range(0.0, 0.008), angle(0.0, 0.02 * kDegree);
    for (std::size_t i = 0; i < kNumRings; ++i)
      range_m[i] = range(random), elevation_rad[i] = angle(random), azimuth_rad[i] = angle(random);
  }

  /// Where a beam meets the hall, or what is measured of it.
  Eigen::Vector3f shoot(std::size_t ring, bool is_exact) {
    const double azimuth = std::uniform_real_distribution<double>(-3.14, 3.14)(random);
    const double up = (2.0 - 26.0 * static_cast<double>(ring) / 63.0) * kDegree;
    const auto beam = [&](double elevation, double to_left) {
      return Eigen::Vector3d(std::cos(elevation) * std::cos(to_left), std::cos(elevation) * std::sin(to_left),
                             std::sin(elevation));
    };
    const Eigen::Vector3d at = beam(up, azimuth);
    const double to_end = (20.0 - (at.x() > 0.0 ? along_m : -along_m)) / std::abs(at.x());
    const double to_side = 6.0 / std::abs(at.y());
    const double to_floor = at.z() < 0.0 ? -1.7 / at.z() : 1e9;
    const double range = std::min({to_end, to_side, to_floor});
    is_ground = to_floor <= range;
    if (is_exact) return (range * at).cast<float>();
    const double noise = std::normal_distribution<double>(0.0, 0.01)(random);
    return ((range - range_m[ring] + noise) * beam(up - elevation_rad[ring], azimuth - azimuth_rad[ring]))
        .cast<float>();
  }

  void fill(registration::CellMap& map, const LaserOffsets& lasers, bool is_exact, int returns) {
    for (int i = 0; i < returns; ++i) {
      const auto ring = static_cast<std::uint8_t>(i % kNumRings);
      const Eigen::Vector3f p = shoot(ring, is_exact);
      map.insert(T_hall_sensor() * lasers.corrected(p, ring).cast<double>(),
                 is_ground ? kGround : kNonGround);
    }
  }
  void learn_from_a_sweep(LaserOffsets& lasers, registration::CellMap& map) {
    registration::PointCloud points(6400);
    std::vector<std::uint8_t> rings;
    for (std::size_t i = 0; i < 6400; ++i) {
      const auto ring = static_cast<std::uint8_t>(i % kNumRings);
      const Eigen::Vector3f p = shoot(ring, false);
      points.add(lasers.corrected(p, ring), 0.0F, is_ground ? kGround : kNonGround);
      rings.push_back(ring);
    }
    lasers.learn(map, points, rings, T_hall_sensor(), {});
  }

  /// Root mean square over the rings of what is left at so many metres: along the beam, and across it.
  Eigen::Vector2d left_over_m(const LaserOffsets& lasers, double at_m) const {
    Eigen::Vector2d sum = Eigen::Vector2d::Zero();
    for (std::size_t i = 0; i < kNumRings; ++i)
      sum += Eigen::Vector2d(double{lasers.range_m(i)} - range_m[i],
                             at_m * (double{lasers.elevation_rad(i)} - elevation_rad[i]))
                 .cwiseAbs2();
    return (sum / kNumRings).cwiseSqrt();
  }

  Eigen::Isometry3d T_hall_sensor() const {
    return Eigen::Isometry3d(Eigen::Translation3d(along_m, 0.0, 0.0));
  }

  std::mt19937 random;
  double along_m = 0.0;  ///< where the sensor is, from the middle
  std::array<double, kNumRings> range_m{}, elevation_rad{}, azimuth_rad{};
  bool is_ground = false;
};

}  // namespace

TEST_CASE("what each laser is off by is learned from the map", "[mapping][lasers]") {
  Hall hall(7);
  LaserOffsets lasers{LasersConfig{}};
  registration::CellMap map(options_of(CellsConfig{}), 20'000);
  hall.fill(map, lasers, true, 60'000);
  const Eigen::Vector2d before = hall.left_over_m(lasers, 6.0);
  for (int sweep = 0; sweep < 30; ++sweep) hall.learn_from_a_sweep(lasers, map);
  const Eigen::Vector2d after = hall.left_over_m(lasers, 6.0);
  INFO("left of " << before.transpose() << " m: " << after.transpose());
  CHECK(before[0] > 0.006);
  CHECK(after[0] < 0.4 * before[0]);
  CHECK(after[1] < before[1]);
}

TEST_CASE("a map that the lasers themselves have made teaches them to agree", "[mapping][lasers]") {
  Hall hall(8);
  LaserOffsets lasers{LasersConfig{}};
  const auto scatter_m = [&] {
    double sum = 0.0, mean = 0.0;
    for (std::size_t i = 0; i < kNumRings; ++i)
      mean += (double{lasers.range_m(i)} - hall.range_m[i]) / kNumRings;
    for (std::size_t i = 0; i < kNumRings; ++i) {
      const double off = double{lasers.range_m(i)} - hall.range_m[i] - mean;
      sum += off * off / kNumRings;
    }
    return std::sqrt(sum);
  };
  const double before_m = scatter_m();
  for (int drive = 0; drive < 4; ++drive) {
    registration::CellMap map(options_of(CellsConfig{}), 20'000);
    for (hall.along_m = -15.0; hall.along_m <= 15.0; hall.along_m += 1.0) {
      hall.learn_from_a_sweep(lasers, map);
      hall.fill(map, lasers, false, 6'400);
    }
  }
  INFO(before_m << " m before, " << scatter_m() << " m after");
  CHECK(scatter_m() < 0.7 * before_m);
}

TEST_CASE("nothing is corrected where nothing was learned", "[mapping][lasers]") {
  Hall hall(9);
  LasersConfig config;
  config.learn = false;
  LaserOffsets lasers{config};
  registration::CellMap map(options_of(CellsConfig{}), 20'000);
  hall.fill(map, lasers, true, 20'000);
  hall.learn_from_a_sweep(lasers, map);
  const Eigen::Vector3f p(3.0F, 4.0F, -1.0F);
  CHECK(lasers.corrected(p, 5) == p);
  LaserOffsets learned{LasersConfig{}};
  hall.learn_from_a_sweep(learned, map);
  CHECK((learned.corrected(p, 5) - p).norm() > 1e-5F);
  learned.reset();
  CHECK(learned.corrected(p, 5) == p);
}
