// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace pago::registration {

/// Exact nearest neighbours of points in space: nanoflann's kd-tree, as the paper presets search. build()
/// allocates, so it is for no hot path (GridIndex and CellMap are). Deterministic. [one thread]
class KdTree {
 public:
  KdTree();
  ~KdTree();
  KdTree(KdTree&&) noexcept;
  KdTree& operator=(KdTree&&) noexcept;

  void build(std::vector<Eigen::Vector3f> points);

  const std::vector<Eigen::Vector3f>& points() const noexcept;

  /// The indices of the nearest points, nearest first, and their squared distances; as many as `indices` has
  /// room for, or all. Returns how many.
  std::size_t nearest(const Eigen::Vector3f& query,
                      std::span<std::uint32_t> indices,
                      std::span<float> squared_m2) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace pago::registration
