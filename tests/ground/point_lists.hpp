// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include "src/ground/points.hpp"

namespace pago::test {

/// Points as plane fits take them.
struct PointLists {
  std::vector<float> x, y, z;
  void add(const Eigen::Vector3d& p) {
    x.push_back(static_cast<float>(p.x()));
    y.push_back(static_cast<float>(p.y()));
    z.push_back(static_cast<float>(p.z()));
  }
  ground::Points view() const { return {x, y, z}; }
};

}  // namespace pago::test
