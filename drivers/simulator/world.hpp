// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ground.hpp"
#include "models.hpp"
#include "scenery.hpp"

namespace pago::simulator {

inline constexpr int kTile_m = 64;

/// The squares that the world is built in: [i, i + 1) x [j, j + 1) times kTile_m.
struct Tile {
  int i = 0, j = 0;
  bool operator==(const Tile&) const = default;

  static Tile of(const Eigen::Vector2d& place) noexcept;
  std::uint64_t key() const noexcept {
    return std::uint64_t{static_cast<std::uint32_t>(i)} << 32U | static_cast<std::uint32_t>(j);
  }
  Eigen::Vector2d corner() const noexcept { return Eigen::Vector2d(i, j) * kTile_m; }
};

/// A thing that stands somewhere; its mesh is made when its tile is.
struct Item {
  enum class Kind : std::uint8_t {
    kHouse,
    kFront,
    kLamp,
    kSign,
    kTree,
    kParkedCar,
    kBin,
    kMarking,
    kHedge,
    kWireFence,
    kNoiseWall,
    kGuardRail,
    kPole,
    kDelineator,
    kTallGrass,
    kBridge,
    kTunnel
  };
  Kind kind = Kind::kHouse;
  Eigen::Vector2d at = Eigen::Vector2d::Zero();
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< the street's direction there
  double side = 1.0;                                 ///< of the street: 1 left, -1 right
  double width_m = 0.0;
  std::uint64_t key = 0;  ///< of its random numbers
};

/// All that stands still, as a function of place and seed: a tile is the same whenever and in whatever order
/// it is built. [set-up] the constructor decides what stands where; [any thread] the rest.
class World {
 public:
  /// Nothing stands on `way`, what the vehicle drives along.
  World(Ground ground, StreetMap way, const Scenery& scenery, std::uint64_t seed);

  Mesh tile(const Tile& tile) const;
  const Ground& ground() const noexcept { return ground_; }

 private:
  void line_streets();
  void line_side(std::span<const StreetPoint> street, double side);
  void add_plots(std::span<const StreetPoint> street, double side);
  void add_furniture(std::span<const StreetPoint> street, double side);
  void add_parked_cars(std::span<const StreetPoint> street, double side);
  void add_markings(std::span<const StreetPoint> street);
  void add_stretches(std::span<const StreetPoint> street, double side);
  void add_guard_rails(std::span<const StreetPoint> street, double side);
  void add_verge(std::span<const StreetPoint> street, double side);
  void add_structures(std::span<const StreetPoint> street);
  bool has_median(const StreetPoint& point, double side) const;
  bool is_clear(const Eigen::Vector2d& at, double from_streets_m) const;
  bool is_free(const Eigen::Vector2d& at, int street, double from_streets_m, double from_way_m) const;
  void put(Item item);

  void build(Mesh& mesh, const Item& item) const;
  void build_house(Mesh& mesh, const Item& item) const;
  void build_front(Mesh& mesh, const Item& item) const;
  void build_parked_car(Mesh& mesh, const Item& item) const;
  void build_marking(Mesh& mesh, const Item& item) const;
  void build_gardens(Mesh& mesh, const Tile& tile) const;
  void build_roadside(Mesh& mesh, const Item& item) const;
  void build_barrier(Mesh& mesh, const Item& item) const;
  void build_guard_rail(Mesh& mesh, const Item& item) const;
  void build_bridge(Mesh& mesh, const Item& item) const;
  void build_tunnel(Mesh& mesh, const Item& item) const;

  Ground ground_;
  StreetMap way_;
  Scenery scenery_;
  std::uint64_t seed_;
  std::unordered_map<std::uint64_t, std::vector<Item>> items_;
  std::vector<Model> trees_, bushes_, tufts_, cars_;
};

}  // namespace pago::simulator
