// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>

#include "pago/core/aligned_array.hpp"

namespace pago::registration {

/// What is fitted to the points of a cell.
enum class CellShape : std::uint8_t { kPlane, kLine };

/// The points of one cell as a Gaussian, and the plane or line through them where they form one. Coordinates
/// are relative to the cell's centre, so that float is exact enough anywhere.
struct alignas(64) Cell {
  Eigen::Vector3f mean_m = Eigen::Vector3f::Zero();
  std::array<float, 6> scatter_m2{};               ///< sum of squared deviations: xx xy xz yy yz zz
  Eigen::Vector3f axis = Eigen::Vector3f::Zero();  ///< the plane's unit normal, or the line's unit direction
  float thickness_m2 = 0.0F;  ///< variance of the points off the plane (along its normal) or line (across it)
  std::uint16_t count = 0;
  std::uint16_t fitted_count = 0;  ///< when the shape was last fitted
  bool has_shape = false;
};

struct CellMapOptions {
  CellShape shape = CellShape::kPlane;
  double cell_m = 1.0;
  int max_points = 30;  ///< later points of a cell are not counted: the oldest have the least drift
  int min_points = 6;   ///< fewer make no shape
  /// Of a plane its least variance over the middle one, of a line the middle one over the greatest.
  double max_flatness = 0.1;
  double max_thickness_m = 0.2;  ///< deviation off the plane or line
  /// Of a plane: deviation along its narrower side. The noise of ranges alone makes a narrow plane of one
  /// ring's arc, and tilts it to the beams.
  double min_width_m = 0.1;
};

/// A map of Gaussian cells: a voxel hash with open addressing in memory that is allocated once. Cells of
/// ground and of other points stand side by side. How points are spread over a cell is updated with every
/// point, and its shape when it is next asked for, so nothing is ever rebuilt. [set-up] constructor; [one
/// thread] the rest: real-time safe, deterministic.
class CellMap {
 public:
  /// Room for `max_cells`; points that would need more are left out and counted.
  CellMap(const CellMapOptions& options, std::uint32_t max_cells);

  void clear() noexcept;

  /// Counts a point. Coordinates beyond a million cells from the origin, and those not finite, are left out.
  void insert(const Eigen::Vector3d& point_m, std::uint8_t surface) noexcept;

  /// The shape that is nearest by its mean among the point's own cell and the three that it is closest to;
  /// `offset_m` is the point relative to that mean. Null where there is none.
  const Cell* find_shape(const Eigen::Vector3d& point_m,
                         std::uint8_t surface,
                         Eigen::Vector3f& offset_m) noexcept;

  /// Removes cells farther than `radius_m` from `centre_m` (seen from above) among the next `num_slots` of
  /// the table: called with every sweep, it goes round and round, and no sweep pays for all.
  void prune(const Eigen::Vector3d& centre_m, double radius_m, std::uint32_t num_slots) noexcept;

  std::uint32_t size() const noexcept { return size_; }
  std::uint32_t max_cells() const noexcept { return max_cells_; }
  std::uint32_t num_slots() const noexcept { return mask_ + 1; }
  /// Points that found no room.
  std::uint64_t left_out() const noexcept { return left_out_; }

 private:
  using Key = std::uint64_t;
  static constexpr Key kNone = ~Key{0};
  static constexpr int kMostCells = 1 << 20;  // to either side of the origin

  /// 21 bits per axis and one for the surface.
  static Key pack(const Eigen::Vector3i& at, std::uint8_t surface) noexcept {
    const auto bits = [](int i) { return static_cast<Key>(static_cast<std::uint32_t>(i + kMostCells)); };
    return bits(at.x()) << 43 | bits(at.y()) << 22 | bits(at.z()) << 1 | (surface & 1U);
  }
  static Eigen::Vector3i unpack(Key key) noexcept {
    const auto index = [](Key bits) { return static_cast<int>(bits & 0x1fffffU) - kMostCells; };
    return {index(key >> 43), index(key >> 22), index(key >> 1)};
  }
  static bool is_inside(const Eigen::Vector3d& in_cells) noexcept {
    constexpr double kMost = kMostCells - 2;
    return std::abs(in_cells.x()) < kMost && std::abs(in_cells.y()) < kMost && std::abs(in_cells.z()) < kMost;
  }
  std::uint32_t home(Key key) const noexcept {
    return static_cast<std::uint32_t>(key * 0x9e3779b97f4a7c15U >> shift_);
  }
  /// The slot of a key, or the empty one where it would go.
  std::uint32_t find(Key key) const noexcept {
    std::uint32_t slot = home(key);
    while (keys_[slot] != key && keys_[slot] != kNone) slot = (slot + 1) & mask_;
    return slot;
  }
  void fit_if_due(Cell& cell) const noexcept;
  void remove(std::uint32_t slot) noexcept;

  CellMapOptions options_;
  double per_cell_;
  std::uint32_t max_cells_, mask_;
  int shift_;
  AlignedArray<Key> keys_;  // apart from the cells: most look-ups of neighbours end here
  AlignedArray<Cell> cells_;
  std::uint32_t size_ = 0, next_pruned_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace pago::registration
