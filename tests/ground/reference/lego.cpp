// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// LeGO-LOAM's ground removal: column by column, with arctangents.
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/ground/reference/points.hpp"

namespace pago::test {
namespace {

double degrees(double y, double x) {
  return std::atan2(y, x) * 180.0 / std::numbers::pi;
}

using Cell = std::function<const Point*(int row, int column)>;  // null: empty

/// 1 where a cell is ground; row by row.
std::vector<int> test_columns(
    const Cell& at, int pairs, int rows, int columns, const LegoConfig& c, bool missing_undoes) {
  std::vector<int> ground(static_cast<std::size_t>(rows * columns), 0);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < pairs; ++row) {
      const auto low = static_cast<std::size_t>(row * columns + column);
      const auto high = low + static_cast<std::size_t>(columns);
      const Point *a = at(row, column), *b = at(row + 1, column);
      if (a == nullptr || b == nullptr) {
        if (missing_undoes) ground[low] = -1;
        continue;
      }
      const Eigen::Vector3d d = b->p - a->p;
      if (std::abs(degrees(d.z(), std::hypot(d.x(), d.y()))) <= c.max_slope_deg)
        ground[low] = ground[high] = 1;
    }
  }
  return ground;
}

/// Pixel of a return by the sensor's own angles, or -1.
int pixel_of(const Eigen::Vector3d& p, const LegoConfig& c) {
  if (!(p.norm() >= c.min_range_m)) return -1;
  const double row =
      (degrees(p.z(), std::hypot(p.x(), p.y())) + c.uniform_bottom_deg) / c.uniform_row_step_deg;
  if (!(row > -1.0 && row < c.uniform_rows)) return -1;
  const double column_step_deg = 360.0 / c.uniform_columns;
  long column = -std::lround((degrees(p.x(), p.y()) - 90.0) / column_step_deg) + c.uniform_columns / 2;
  if (column >= c.uniform_columns) column -= c.uniform_columns;
  return static_cast<int>(row) * c.uniform_columns + static_cast<int>(column);
}

Mask uniform(const Sweep& sweep, const LegoConfig& c, const Mount& mount) {
  const int rows = c.uniform_rows, columns = c.uniform_columns;
  const PointList points = returns_of(sweep, mount);
  std::vector<const Point*> holder(static_cast<std::size_t>(rows * columns), nullptr);
  const Eigen::Matrix3d R_sensor_level = mount.R_level_sensor().transpose();
  std::vector<int> pixel(points.size());
  for (std::size_t k = 0; k < points.size(); ++k) {
    pixel[k] = pixel_of(R_sensor_level * points[k].p, c);
    if (pixel[k] >= 0) holder[static_cast<std::size_t>(pixel[k])] = &points[k];
  }
  const auto at = [&](int row, int column) {
    return holder[static_cast<std::size_t>(row * columns + column)];
  };
  const std::vector<int> ground =
      test_columns(at, std::min(c.ground_rings, rows - 1), rows, columns, c, true);
  Mask mask = empty_mask(sweep);
  for (std::size_t k = 0; k < points.size(); ++k)
    if (pixel[k] >= 0 && ground[static_cast<std::size_t>(pixel[k])] == 1) mask[points[k].index] = kGround;
  return mask;
}

Mask ring(const Sweep& sweep, const LegoConfig& c, const Mount& mount) {
  std::vector<const Point*> of_return(sweep.size, nullptr);
  const PointList points = returns_of(sweep, mount);
  for (const Point& point : points)
    if (point.p.norm() >= c.min_range_m) of_return[point.index] = &point;
  const int columns = static_cast<int>(sweep.header.num_columns);
  const auto at = [&](int row, int column) {
    const std::int32_t cell = sweep.range_image.at(row, column);
    return cell < 0 ? nullptr : of_return[static_cast<std::size_t>(cell)];
  };
  const std::vector<int> ground =
      test_columns(at, std::min(c.ground_rings, kNumRings - 1), kNumRings, columns, c, false);
  Mask mask = empty_mask(sweep);
  for (int row = 0; row < kNumRings; ++row)
    for (int column = 0; column < columns; ++column)
      if (ground[static_cast<std::size_t>(row * columns + column)] == 1)
        mask[static_cast<std::size_t>(sweep.range_image.at(row, column))] = kGround;
  return mask;
}

}  // namespace

Reference lego_reference(const LegoConfig& c, const Mount& mount) {
  const auto projection = c.projection == LegoConfig::Projection::kUniform ? uniform : ring;
  return [c, mount, projection](const Sweep& sweep) { return projection(sweep, c, mount); };
}

}  // namespace pago::test
