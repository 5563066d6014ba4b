// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "concentric_zones.hpp"

#include <cmath>

#include "pago/core/error.hpp"

namespace pago::ground {
namespace {

int whole_number(const std::string& key, double value) {
  if (value == std::floor(value)) return static_cast<int>(value);
  throw Error(key, "must be whole numbers, has " + std::to_string(value));
}

}  // namespace

PolarGrid concentric_zones(const std::string& section,
                           double near_m,
                           double far_m,
                           const std::array<double, 4>& rings,
                           const std::array<double, 4>& sectors) {
  if (!(near_m < far_m)) throw Error(section + ".max_range_m", "must be greater than min_range_m");
  const std::array<double, 4> lower_m{near_m, (7.0 * near_m + far_m) / 8.0, (3.0 * near_m + far_m) / 4.0,
                                      (near_m + far_m) / 2.0};
  std::array<PolarZone, 4> zones;
  for (std::size_t i = 0; i < zones.size(); ++i)
    zones[i] = {lower_m[i], whole_number(section + ".zone_rings", rings[i]),
                whole_number(section + ".zone_sectors", sectors[i])};
  return PolarGrid(zones, far_m);
}

}  // namespace pago::ground
