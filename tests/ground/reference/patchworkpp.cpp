// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <numbers>

#include "tests/ground/reference/points.hpp"

namespace pago::test {
namespace {

struct Spread {
  double mean = 0.0, deviation = 0.0;
};
template <typename Numbers>
Spread spread_of(const Numbers& numbers) {
  Spread spread;
  if (numbers.empty()) return spread;
  const double n = static_cast<double>(numbers.size());
  for (const double number : numbers) spread.mean += number / n;
  for (const double number : numbers) spread.deviation += (number - spread.mean) * (number - spread.mean);
  spread.deviation = numbers.size() < 2 ? 0.0 : std::sqrt(spread.deviation / (n - 1.0));
  return spread;
}

/// What is learnt.
struct Knowledge {
  double height_m;
  std::array<double, 4> max_z_m, max_flatness{};
  std::array<std::deque<double>, 4> z_m, flatness;
};

struct Patch {
  PointList ground;
  Plane plane;
  double flatness = 0.0;
};

class Sequence {
 public:
  Sequence(const PatchworkppConfig& c, const Mount& mount) : c_(c), mount_(mount) {
    known_.height_m = mount.height_m;
    known_.max_z_m.fill(c.max_elevation_m - mount.height_m);
  }

  Mask segment(const Sweep& sweep) {
    std::map<int, std::map<ZoneBin, PointList>> rings;
    for (const Point& point : returns_of(sweep, mount_)) {
      if (c_.removes_reflections && is_reflection(point, sweep.intensity[point.index])) continue;
      if (!(point.range() > c_.min_range_m && point.range() <= c_.max_range_m)) continue;
      const ZoneBin id = zone_bin_of(point, c_.min_range_m, c_.max_range_m, c_.zone_rings, c_.zone_sectors);
      rings[id.ring][id].push_back(point);
    }
    Mask mask = empty_mask(sweep);
    for (const auto& [ring, bins] : rings) segment_ring(ring, bins, mask);
    learn();
    return mask;
  }

 private:
  bool is_reflection(const Point& point, std::uint8_t intensity) const {
    const double angle_deg = std::atan2(point.p.z(), point.range()) * 180.0 / std::numbers::pi;
    return angle_deg < c_.reflection_angle_deg && point.p.z() < -known_.height_m - c_.reflection_depth_m &&
           intensity < 255.0 * c_.reflection_intensity;
  }

  double floor_of(const ZoneBin& id) const {
    return id.zone == 0 ? -c_.lowest_margin * known_.height_m : -std::numeric_limits<double>::infinity();
  }

  PointList without_walls(PointList points, const ZoneBin& id) const {
    for (int i = 0; i < c_.iterations && c_.removes_uprights && id.zone == 0; ++i) {
      const double lowest_m = lowest_mean(points, c_.lowest_points, floor_of(id));
      const Plane plane = fit(lower_than(points, lowest_m + c_.upright_seed_height_m));
      if (!plane.is_valid || plane.normal.z() >= c_.min_uprightness) break;
      std::erase_if(points, [&](const Point& point) {
        return std::abs(plane.above(point.p)) < c_.upright_thickness_m;
      });
    }
    return points;
  }

  Patch patch_of(const PointList& bin, const ZoneBin& id) const {
    if (bin.size() < static_cast<std::size_t>(c_.min_points)) return {};
    const PointList points = without_walls(bin, id);
    const double lowest_m = lowest_mean(points, c_.lowest_points, floor_of(id));
    const Plane plane =
        grow(points, points, lowest_m + c_.seed_height_m, c_.ground_thickness_m, c_.iterations);
    if (!plane.is_valid) return {};
    Patch patch;
    patch.ground = below(points, plane, c_.ground_thickness_m);
    patch.plane = fit(patch.ground);
    const double n = static_cast<double>(patch.ground.size());
    if (patch.plane.is_valid) patch.flatness = patch.plane.variance[0] * n / (n - 1.0);
    return patch;
  }

  void segment_ring(int ring, const std::map<ZoneBin, PointList>& bins, Mask& mask) {
    std::vector<Patch> candidates;
    std::vector<double> flatness;
    for (const auto& [id, bin] : bins) {
      const Patch patch = patch_of(bin, id);
      if (!patch.plane.is_valid || !(patch.plane.normal.z() > c_.min_uprightness)) continue;
      if (ring >= 4) {
        mark(mask, patch.ground);
        continue;
      }
      const auto r = static_cast<std::size_t>(ring);
      const bool is_low = patch.plane.mean.z() < known_.max_z_m[r];
      if (is_low) {
        known_.z_m[r].push_back(patch.plane.mean.z());
        known_.flatness[r].push_back(patch.flatness);
        flatness.push_back(patch.flatness);
      }
      if (patch.plane.mean.dot(patch.plane.normal) >= 0.0) continue;
      if (is_low || patch.flatness < known_.max_flatness[r]) {
        mark(mask, patch.ground);
      } else {
        candidates.push_back(patch);
      }
    }
    for (const Patch& patch : candidates)
      if (c_.reverts && is_reverted(patch, flatness)) mark(mask, patch.ground);
  }

  bool is_reverted(const Patch& patch, const std::vector<double>& flatness) const {
    const Spread ring = spread_of(flatness);
    const double usual = flatness.size() < 2 ? 0.0 : ring.mean + 1.5 * ring.deviation;
    double probability =
        usual > 0.0 ? 1.0 / (1.0 + std::exp((patch.flatness - usual) / (usual / 10.0))) : 0.0;
    if (patch.ground.size() > static_cast<std::size_t>(c_.large_points) &&
        patch.flatness < c_.ground_thickness_m * c_.ground_thickness_m)
      probability = 1.0;
    if (patch.plane.variance[2] / patch.plane.variance[1] > c_.max_line_ratio) probability = 0.0;
    return probability > 0.5;
  }

  void learn() {
    for (std::size_t r = 0; r < 4; ++r) {
      const auto memory = static_cast<std::size_t>(c_.memory);
      while (known_.z_m[r].size() > memory) known_.z_m[r].pop_front();
      while (known_.flatness[r].size() > memory) known_.flatness[r].pop_front();
      if (known_.z_m[r].empty()) continue;
      const Spread z = spread_of(known_.z_m[r]);
      const double elevation_m = z.mean + (r == 0 ? 3.0 : 2.0) * z.deviation + mount_.height_m;
      known_.max_z_m[r] = std::clamp(elevation_m, -c_.max_elevation_m, c_.max_elevation_m) - mount_.height_m;
      if (r == 0)
        known_.height_m = std::clamp(-z.mean, mount_.height_m - c_.max_height_change_m,
                                     mount_.height_m + c_.max_height_change_m);
      if (known_.flatness[r].size() < 2) continue;
      const Spread flatness = spread_of(known_.flatness[r]);
      known_.max_flatness[r] = flatness.mean + flatness.deviation;
    }
  }

  PatchworkppConfig c_;
  Mount mount_;
  Knowledge known_;
};

}  // namespace

Reference patchworkpp_reference(const PatchworkppConfig& c, const Mount& mount) {
  return [sequence = std::make_shared<Sequence>(c, mount)](const Sweep& sweep) {
    return sequence->segment(sweep);
  };
}

}  // namespace pago::test
