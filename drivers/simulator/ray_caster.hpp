// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>

#include "surface.hpp"
#include "world.hpp"

namespace pago::simulator {

/// The first thing that a ray meets.
struct Hit {
  float range_m = std::numeric_limits<float>::infinity();  ///< infinite: nothing
  Eigen::Vector3f normal = Eigen::Vector3f::UnitZ();  ///< of the triangle, in the world's axes; any length
  Surface surface;

  bool is_there() const noexcept { return range_m < 1e30F; }
};

/// Rays side by side, about RayCaster::origin(); directions are unit vectors.
struct RayPacket {
  static constexpr std::size_t kSize = 8;
  alignas(32) std::array<float, kSize> x_m{}, y_m{}, z_m{}, dx{}, dy{}, dz{};

  Eigen::Vector3f foot(std::size_t i) const noexcept { return {x_m[i], y_m[i], z_m[i]}; }
  Eigen::Vector3f way(std::size_t i) const noexcept { return {dx[i], dy[i], dz[i]}; }
  void set_foot(std::size_t i, const Eigen::Vector3f& p) noexcept {
    x_m[i] = p.x(), y_m[i] = p.y(), z_m[i] = p.z();
  }
  void set_way(std::size_t i, const Eigen::Vector3f& d) noexcept {
    dx[i] = d.x(), dy[i] = d.y(), dz[i] = d.z();
  }
};

/// Casts rays at what stands still, tile by tile as the vehicle comes near. Memory is bounded by what lies
/// within the sensor's sight. [one thread] cast: no allocation, no lock.
class RayCaster {
 public:
  static constexpr double kSight_m = 125.0;
  static constexpr float kNearest_m = 0.3F;

  /// `make_tile` is called once for each tile whenever it comes into sight.
  explicit RayCaster(std::function<Mesh(const Tile&)> make_tile);
  ~RayCaster();

  /// Has all tiles within sight of a place ready; to be called before the vehicle has gone on by 8 m. Builds
  /// what is new, so it takes its time.
  void move_to(const Eigen::Vector3d& place);

  /// What ray coordinates count from: near the vehicle, so that single precision is enough.
  const Eigen::Vector3d& origin() const noexcept;

  void cast(const RayPacket& rays, std::array<Hit, RayPacket::kSize>& hits) const noexcept;
  /// One ray of a packet again, from this range on: what lies behind something transparent.
  Hit cast_on(const RayPacket& rays, std::size_t index, float from_m) const noexcept;

  std::size_t num_tiles() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago::simulator
