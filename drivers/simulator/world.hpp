// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "ground.hpp"
#include "models.hpp"

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

/// How a world's streets are lined. Chances are per slot of the thing in question.
struct TownStyle {
  double house = 0.7;      ///< of plots that have one
  double gap = 0.5;        ///< of houses with a gap beside them
  double set_back = 0.45;  ///< of houses that stand behind a front garden
  int low_storeys = 2, high_storeys = 5;
  double tree_lined = 0.5;    ///< of street sides
  double parked = 0.5;        ///< of kerb slots on the average street; each street has its own
  double garden_tree = 0.16;  ///< per 7 m square off the streets
};

/// A thing that stands somewhere; its mesh is made when its tile is.
struct Item {
  enum class Kind : std::uint8_t { kHouse, kFront, kLamp, kSign, kTree, kParkedCar, kBin, kMarking };
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
  World(Ground ground, StreetMap way, const TownStyle& style, std::uint64_t seed);

  Mesh tile(const Tile& tile) const;
  const Ground& ground() const noexcept { return ground_; }

 private:
  void line_streets();
  void line_side(std::span<const StreetPoint> street, double side);
  void add_plots(std::span<const StreetPoint> street, double side);
  void add_furniture(std::span<const StreetPoint> street, double side);
  void add_parked_cars(std::span<const StreetPoint> street, double side);
  void add_markings(std::span<const StreetPoint> street);
  bool is_free(const Eigen::Vector2d& at, int street, double from_streets_m, double from_way_m) const;
  void put(Item item);

  void build(Mesh& mesh, const Item& item) const;
  void build_house(Mesh& mesh, const Item& item) const;
  void build_front(Mesh& mesh, const Item& item) const;
  void build_parked_car(Mesh& mesh, const Item& item) const;
  void build_marking(Mesh& mesh, const Item& item) const;
  void build_gardens(Mesh& mesh, const Tile& tile) const;

  Ground ground_;
  StreetMap way_;
  TownStyle style_;
  std::uint64_t seed_;
  std::unordered_map<std::uint64_t, std::vector<Item>> items_;
  std::vector<Model> trees_, bushes_, cars_;
};

}  // namespace pago::simulator
