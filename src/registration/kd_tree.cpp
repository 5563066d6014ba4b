// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/registration/kd_tree.hpp"

#include <algorithm>
#include <nanoflann.hpp>
#include <utility>

namespace pago::registration {

namespace {

struct Points {
  std::vector<Eigen::Vector3f> list;
  std::size_t kdtree_get_point_count() const { return list.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return list[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

}  // namespace

struct KdTree::Tree {
  using Index = nanoflann::
      KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>, Points, 3, std::uint32_t>;

  explicit Tree(std::vector<Eigen::Vector3f> list) : points{std::move(list)}, index(3, points) {}

  Points points;
  Index index;
};

KdTree::KdTree() : tree_(std::make_unique<Tree>(std::vector<Eigen::Vector3f>{})) {}
KdTree::~KdTree() = default;
KdTree::KdTree(KdTree&&) noexcept = default;
KdTree& KdTree::operator=(KdTree&&) noexcept = default;

void KdTree::build(std::vector<Eigen::Vector3f> points) {
  tree_ = std::make_unique<Tree>(std::move(points));
}

const std::vector<Eigen::Vector3f>& KdTree::points() const noexcept {
  return tree_->points.list;
}

std::size_t KdTree::nearest(const Eigen::Vector3f& query,
                            std::span<std::uint32_t> indices,
                            std::span<float> squared_m2) const {
  const std::size_t wanted = std::min(indices.size(), squared_m2.size());
  if (points().empty() || wanted == 0) return 0;
  return tree_->index.knnSearch(query.data(), wanted, indices.data(), squared_m2.data());
}

}  // namespace pago::registration
