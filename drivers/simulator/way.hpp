// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

namespace pago::simulator {

/// A line in the plane that is asked for points by their distance from its start. Distances beyond either end
/// continue it straight.
class Way {
 public:
  Way() = default;
  explicit Way(std::vector<Eigen::Vector2d> line) : line_(std::move(line)), length_m_(line_.size(), 0.0) {
    for (std::size_t i = 1; i < line_.size(); ++i)
      length_m_[i] = length_m_[i - 1] + (line_[i] - line_[i - 1]).norm();
  }

  double length_m() const noexcept { return length_m_.back(); }
  std::span<const Eigen::Vector2d> line() const noexcept { return line_; }

  Eigen::Vector2d at(double s_m) const noexcept {
    const auto after = std::upper_bound(length_m_.begin() + 1, length_m_.end() - 1, s_m);
    const auto i = static_cast<std::size_t>(after - length_m_.begin());
    const double share = (s_m - length_m_[i - 1]) / std::max(1e-9, length_m_[i] - length_m_[i - 1]);
    return line_[i - 1] + share * (line_[i] - line_[i - 1]);
  }
  /// Beside the way: `left_m` to the left of the point at `s_m`.
  Eigen::Vector2d beside(double s_m, double left_m) const noexcept {
    const Eigen::Vector2d along = (at(s_m + 0.5) - at(s_m - 0.5)).normalized();
    return at(s_m) + left_m * Eigen::Vector2d(-along.y(), along.x());
  }

 private:
  std::vector<Eigen::Vector2d> line_;
  std::vector<double> length_m_;
};

}  // namespace pago::simulator
