// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "settings.hpp"

namespace pago {
namespace {

/// A sentence that must hold, and the settings that it is about.
struct Rule {
  bool (*holds)(const Config&);
  std::string_view sentence;
  std::array<std::string_view, 2> keys;
};

bool are_whole(std::span<const double> numbers) {
  return std::ranges::all_of(numbers, [](double number) { return number == std::floor(number); });
}

template <auto section>
bool has_range(const Config& c) {
  return (c.ground.*section).min_range_m < (c.ground.*section).max_range_m;
}

template <auto section>
bool has_whole_zones(const Config& c) {
  return are_whole((c.ground.*section).zone_rings) && are_whole((c.ground.*section).zone_sectors);
}

constexpr std::array kRules{
    Rule{[](const Config& c) { return c.assembly.max_returns == 0 || c.assembly.max_returns >= 64'000; },
         "a sweep must hold 64,000 returns at least, or 0 for as many as the sensor needs",
         {"assembly.max_returns", ""}},
    Rule{[](const Config& c) { return c.record.keep_files == 0 || c.record.file_mb > 0; },
         "there are files to be kept or not only where their size is limited",
         {"record.keep_files", "record.file_mb"}},
    Rule{[](const Config& c) { return c.hdl64.min_range_m < c.hdl64.max_range_m; },
         "the sensor's nearest range must be below its farthest",
         {"hdl64.min_range_m", "hdl64.max_range_m"}},
    Rule{has_range<&GroundConfig::patchwork>,
         "Patchwork's zones must begin before they end",
         {"ground.patchwork.min_range_m", "ground.patchwork.max_range_m"}},
    Rule{has_whole_zones<&GroundConfig::patchwork>,
         "Patchwork's zones must be divided by whole numbers",
         {"ground.patchwork.zone_rings", "ground.patchwork.zone_sectors"}},
    Rule{has_range<&GroundConfig::patchwork_hdl64>,
         "Patchwork's zones must begin before they end",
         {"ground.patchwork_hdl64.min_range_m", "ground.patchwork_hdl64.max_range_m"}},
    Rule{has_whole_zones<&GroundConfig::patchwork_hdl64>,
         "Patchwork's zones must be divided by whole numbers",
         {"ground.patchwork_hdl64.zone_rings", "ground.patchwork_hdl64.zone_sectors"}},
    Rule{has_range<&GroundConfig::patchworkpp>,
         "Patchwork++'s zones must begin before they end",
         {"ground.patchworkpp.min_range_m", "ground.patchworkpp.max_range_m"}},
    Rule{has_whole_zones<&GroundConfig::patchworkpp>,
         "Patchwork++'s zones must be divided by whole numbers",
         {"ground.patchworkpp.zone_rings", "ground.patchworkpp.zone_sectors"}},
    Rule{has_range<&GroundConfig::linefit>,
         "LineFit's lines must begin before they end",
         {"ground.linefit.min_range_m", "ground.linefit.max_range_m"}},
    Rule{has_range<&GroundConfig::cascaded>,
         "CascadedSeg's regions must begin before they end",
         {"ground.cascaded.min_range_m", "ground.cascaded.max_range_m"}},
    Rule{[](const Config& c) {
           return c.features.clustering.min_points_tall <= c.features.clustering.min_points;
         },
         "a tall segment cannot be asked for more returns than any segment",
         {"features.clustering.min_points_tall", "features.clustering.min_points"}},
    Rule{[](const Config& c) { return c.features.sharp_edges_per_sector <= c.features.edges_per_sector; },
         "the sharp edges are the first of the edges and cannot be more",
         {"features.sharp_edges_per_sector", "features.edges_per_sector"}},
};

std::string values_text(const config::Settings& settings, const Rule& rule) {
  std::string out;
  for (const auto key : rule.keys) {
    const config::Setting* setting = settings.find(key);
    if (setting != nullptr)
      out += (out.empty() ? "" : ", ") + setting->key + " is " + to_text(value_of(*setting));
  }
  return out;
}

}  // namespace

void validate(const Config& config) {
  Config copy = config;
  const config::Settings settings = config::settings_of(copy);
  for (const config::Setting& setting : settings.list) {
    const config::Value value = value_of(setting);
    if (!assign(setting, value))
      throw Error("configuration",
                  setting.key + " must be " + expectation(setting) + ", is " + to_text(value));
  }
  for (const Rule& rule : kRules)
    if (!rule.holds(config))
      throw Error("configuration", std::string(rule.sentence), values_text(settings, rule));
}

}  // namespace pago
