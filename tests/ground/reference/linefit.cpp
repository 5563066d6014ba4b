// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/QR>
#include <cmath>
#include <list>
#include <map>
#include <numbers>
#include <optional>

#include "tests/ground/reference/points.hpp"

namespace pago::test {
namespace {

struct Spot {
  double d, z;
};
struct Line {
  double slope, base, from, until;
};

Line fit_line(const std::list<Spot>& spots) {
  Eigen::MatrixXd A(spots.size(), 2);
  Eigen::VectorXd b(spots.size());
  Eigen::Index row = 0;
  for (const Spot& spot : spots) {
    A.row(row) << spot.d, 1.0;
    b[row++] = spot.z;
  }
  const Eigen::VectorXd line = A.colPivHouseholderQr().solve(b);
  return {line[0], line[1], spots.front().d, spots.back().d};
}

double max_error(const std::list<Spot>& spots, const Line& line) {
  double worst = 0.0;
  for (const Spot& spot : spots) worst = std::max(worst, std::abs(line.slope * spot.d + line.base - spot.z));
  return worst;
}

std::vector<Line> lines_through(const std::vector<Spot>& spots,
                                double ground_z,
                                const LinefitConfig& c,
                                WideGap gap) {
  std::vector<Line> lines;
  if (spots.empty()) return lines;
  std::list<Spot> run{spots[0]};
  std::optional<Line> current;
  bool is_long = false;
  std::size_t next = 1;
  while (next < spots.size()) {
    const Spot& spot = spots[next];
    if (spot.d - run.back().d > c.long_gap_m) is_long = true;
    if (run.size() == 1) {
      if (!(spot.d - run.back().d < c.long_gap_m && std::abs(run.back().z - ground_z) < c.max_start_step_m))
        run.clear();
      run.push_back(spot);
      ++next;
      continue;
    }
    const bool is_pair_at_gap = is_long && run.size() == 2;
    const std::optional<double> expected =
        is_long && run.size() > 2 ? std::optional(current->slope * spot.d + current->base) : std::nullopt;
    run.push_back(spot);
    current = fit_line(run);
    const bool is_bad = max_error(run, *current) > c.max_fit_error_m ||
                        std::abs(current->slope) > c.max_slope ||
                        (run.size() > 2 && std::abs(current->slope) < c.min_slope) ||
                        (expected && std::abs(*expected - spot.z) > c.max_long_step_m) ||
                        (is_pair_at_gap && gap == WideGap::kEndsPairs);
    if (!is_bad) {
      ++next;
      continue;
    }
    run.pop_back();
    if (run.size() >= 3) {
      lines.push_back(fit_line(run));
      ground_z = lines.back().slope * run.back().d + lines.back().base;
    }
    is_long = false;
    run = {run.back()};  // and the same spot again
  }
  if (run.size() > 2) lines.push_back(fit_line(run));
  return lines;
}

/// Vertical distance to the last line that holds at d.
std::optional<double> distance(const std::vector<Line>& lines, const Spot& spot, double reach) {
  std::optional<double> result;
  for (const Line& line : lines)
    if (line.from - reach < spot.d && line.until + reach > spot.d)
      result = std::abs(spot.z - (line.slope * spot.d + line.base));
  return result;
}

std::optional<double> nearer(const std::optional<double>& a, const std::optional<double>& b) {
  if (a && b) return std::min(*a, *b);
  return a ? a : b;
}

}  // namespace

Reference linefit_reference(const LinefitConfig& c, const Mount& mount, WideGap gap) {
  return [c, mount, gap](const Sweep& sweep) {
    const double bin_step = (c.max_range_m - c.min_range_m) / c.bins;
    const double segment_step = 2.0 * std::numbers::pi / c.segments;
    const auto segment_of = [&](const Point& point) {
      return std::min(static_cast<int>(point.azimuth() / segment_step), c.segments - 1);
    };
    PointList points;
    std::map<int, std::map<int, Spot>> lowest;
    for (const Point& point : returns_of(sweep, mount)) {
      if (!(point.range() > c.min_range_m && point.range() <= c.max_range_m)) continue;
      points.push_back(point);
      const int bin = std::min(static_cast<int>((point.range() - c.min_range_m) / bin_step), c.bins - 1);
      const Spot spot{point.range(), point.p.z()};
      const auto [held, is_new] = lowest[segment_of(point)].emplace(bin, spot);
      if (!is_new && spot.z < held->second.z) held->second = spot;
    }
    std::vector<std::vector<Line>> lines(static_cast<std::size_t>(c.segments));
    for (const auto& [segment, bins] : lowest) {
      std::vector<Spot> spots;
      for (const auto& [bin, spot] : bins) spots.push_back(spot);
      lines[static_cast<std::size_t>(segment)] = lines_through(spots, -mount.height_m, c, gap);
    }
    Mask mask = empty_mask(sweep);
    for (const Point& point : points) {
      const Spot spot{point.range(), point.p.z()};
      const auto off_lines_of = [&](int segment) {
        const int wrapped = (segment + c.segments) % c.segments;
        return distance(lines[static_cast<std::size_t>(wrapped)], spot, c.line_reach_m);
      };
      const int segment = segment_of(point);
      std::optional<double> off = off_lines_of(segment);
      for (int k = 1; !off && k * segment_step < c.line_search_angle_rad && k <= c.segments / 2; ++k)
        off = nearer(off_lines_of(segment + k), off_lines_of(segment - k));
      if (off && *off < c.max_distance_to_line_m) mask[point.index] = kGround;
    }
    return mask;
  };
}

}  // namespace pago::test
