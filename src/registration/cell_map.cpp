// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/cell_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <bit>

namespace pago::registration {

namespace {

Eigen::Vector3i floor_of(const Eigen::Vector3d& in_cells) noexcept {
  return {static_cast<int>(std::floor(in_cells.x())), static_cast<int>(std::floor(in_cells.y())),
          static_cast<int>(std::floor(in_cells.z()))};
}

}  // namespace

// At most two slots in three are taken, so that probes stay short.
CellMap::CellMap(const CellMapOptions& options, std::uint32_t max_cells)
    : options_(options),
      per_cell_(1.0 / options.cell_m),
      max_cells_(max_cells),
      mask_(std::bit_ceil(max_cells + max_cells / 2) - 1),
      shift_(64 - std::countr_one(mask_)),
      keys_(mask_ + 1, kNone),
      cells_(mask_ + 1) {}

void CellMap::clear() noexcept {
  std::fill(keys_.begin(), keys_.end(), kNone);
  size_ = 0;
}

void CellMap::insert(const Eigen::Vector3d& point_m, std::uint8_t surface) noexcept {
  const Eigen::Vector3d in_cells = point_m * per_cell_;
  if (!is_inside(in_cells)) return;  // NaN too
  const Eigen::Vector3i at = floor_of(in_cells);
  const Key key = pack(at, surface);
  const std::uint32_t slot = find(key);
  Cell& cell = cells_[slot];
  if (keys_[slot] == kNone) {
    if (size_ == max_cells_) {
      ++left_out_;
      return;
    }
    keys_[slot] = key;
    cell = {};
    ++size_;
  }
  if (cell.count >= options_.max_points) return;
  ++cell.count;

  const Eigen::Vector3f p = ((in_cells - at.cast<double>()).array() - 0.5).matrix().cast<float>() *
                            static_cast<float>(options_.cell_m);
  // Welford 1962: numerically stable for any number of points.
  const Eigen::Vector3f before = p - cell.mean_m;
  cell.mean_m += before / static_cast<float>(cell.count);
  const Eigen::Vector3f after = p - cell.mean_m;
  auto& s = cell.scatter_m2;
  s[0] += before.x() * after.x(), s[1] += before.x() * after.y(), s[2] += before.x() * after.z();
  s[3] += before.y() * after.y(), s[4] += before.y() * after.z(), s[5] += before.z() * after.z();
}

// Fitted anew when a quarter has been added, and when the cell is full.
void CellMap::fit_if_due(Cell& cell) const noexcept {
  if (cell.count < options_.min_points || cell.count == cell.fitted_count) return;
  if (4 * cell.count < 5 * cell.fitted_count && cell.count < options_.max_points) return;
  const auto& s = cell.scatter_m2;
  Eigen::Matrix3d covariance;
  covariance << s[0], s[1], s[2], s[1], s[3], s[4], s[2], s[4], s[5];
  covariance /= cell.count;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const bool is_plane = options_.shape == CellShape::kPlane;
  const Eigen::Vector3d variance = solver.eigenvalues().cwiseMax(0.0);
  const double off = is_plane ? variance[0] : variance[1], along = is_plane ? variance[1] : variance[2];
  cell.fitted_count = cell.count;
  cell.has_shape = off < options_.max_flatness * along &&
                   off < options_.max_thickness_m * options_.max_thickness_m &&
                   along > options_.min_width_m * options_.min_width_m;
  cell.axis = solver.eigenvectors().col(is_plane ? 0 : 2).cast<float>();
  cell.thickness_m2 = static_cast<float>(off);
}

const Cell* CellMap::find_shape(const Eigen::Vector3d& point_m,
                                std::uint8_t surface,
                                Eigen::Vector3f& offset_m) noexcept {
  const Eigen::Vector3d in_cells = point_m * per_cell_;
  if (!is_inside(in_cells)) return nullptr;
  const Eigen::Vector3i own = floor_of(in_cells);
  const Eigen::Vector3f p = ((in_cells - own.cast<double>()).array() - 0.5).matrix().cast<float>();
  const Cell* best = nullptr;
  float best_sq = 0.0F;
  const auto consider = [&](const Eigen::Vector3i& step) {
    const std::uint32_t slot = find(pack(own + step, surface));
    if (keys_[slot] == kNone) return;
    fit_if_due(cells_[slot]);
    if (!cells_[slot].has_shape) return;
    const Eigen::Vector3f offset =
        (p - step.cast<float>()) * static_cast<float>(options_.cell_m) - cells_[slot].mean_m;
    const float distance_sq = offset.squaredNorm();
    if (best != nullptr && distance_sq >= best_sq) return;
    best = &cells_[slot], best_sq = distance_sq, offset_m = offset;
  };
  consider({0, 0, 0});
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::Vector3i step = Eigen::Vector3i::Zero();
    step[axis] = p[axis] < 0.0F ? -1 : 1;
    consider(step);
  }
  return best;
}

void CellMap::prune(const Eigen::Vector3d& centre_m, double radius_m, std::uint32_t num_slots) noexcept {
  const Eigen::Vector2d centre = centre_m.head<2>() * per_cell_;
  const double radius = radius_m * per_cell_;
  for (std::uint32_t n = 0; n < num_slots; ++n) {
    const std::uint32_t slot = next_pruned_;
    const bool is_far =
        keys_[slot] != kNone &&
        (unpack(keys_[slot]).head<2>().cast<double>() - centre).squaredNorm() > radius * radius;
    if (is_far) {
      remove(slot);  // another cell may move in: look at the slot again
    } else {
      next_pruned_ = (slot + 1) & mask_;
    }
  }
}

// Knuth, The Art of Computer Programming 3, 6.4 algorithm R: what follows moves up where it may, so that no
// look-up meets a hole.
void CellMap::remove(std::uint32_t slot) noexcept {
  std::uint32_t hole = slot;
  for (std::uint32_t next = (slot + 1) & mask_; keys_[next] != kNone; next = (next + 1) & mask_) {
    const std::uint32_t wanted = home(keys_[next]);
    if (((next - wanted) & mask_) < ((next - hole) & mask_))
      continue;  // it would come to stand before its home
    keys_[hole] = keys_[next];
    cells_[hole] = cells_[next];
    hole = next;
  }
  keys_[hole] = kNone;
  --size_;
}

}  // namespace pago::registration
