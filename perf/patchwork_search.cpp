// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// How the settings of patchwork-hdl64 were chosen: a coordinate search from the paper's settings, one setting
// after the other over a few values, for the mean F1 by both protocols over labelled sweeps of the simulator,
// as many of streets as of rough country. Prints each step that gained something, and the settings at the
// end. docs/ground.md says what came out, and on what it was judged, which is none of these sweeps.
#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/core/error.hpp"
#include "pago/core/sweep.hpp"
#include "pago/evaluation/ground_metrics.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/pipeline/sweep_reader.hpp"
#include "pago/simulator/simulator_source.hpp"

using namespace pago;

namespace {

constexpr int kSeeds[] = {31, 32, 33, 34, 35};
constexpr int kEvery = 7, kFirst = 2;  // of the 30 sweeps of each drive
constexpr int kPasses = 3;

/// A setting and what it may be. Bounds that the sweeps cannot teach are none of them: src/config/
/// patchwork_hdl64.cpp.
struct Setting {
  std::string name;
  std::vector<double> values;
  std::function<void(PatchworkConfig&, double)> set;
};

template <typename Member>
Setting setting(std::string name, Member PatchworkConfig::*member, std::vector<double> values) {
  return {std::move(name), std::move(values),
          [member](PatchworkConfig& c, double value) { c.*member = static_cast<Member>(value); }};
}

Setting zone_setting(const std::string& name,
                     std::array<double, 4> PatchworkConfig::*member,
                     std::size_t zone,
                     std::vector<double> values) {
  return {name + "[" + std::to_string(zone) + "]", std::move(values),
          [member, zone](PatchworkConfig& c, double value) { (c.*member)[zone] = value; }};
}

/// The drives have few steep slopes, which a bound on elevation lower than the paper's would cut off.
std::vector<double> not_below(double paper, std::vector<double> values) {
  std::erase_if(values, [paper](double value) { return value < paper; });
  return values;
}

std::vector<Setting> settings() {
  std::vector<Setting> all;
  for (std::size_t zone = 0; zone < 4; ++zone) {
    all.push_back(zone_setting("zone_rings", &PatchworkConfig::zone_rings, zone, {2, 3, 4, 5, 6, 8}));
    all.push_back(
        zone_setting("zone_sectors", &PatchworkConfig::zone_sectors, zone, {16, 24, 32, 48, 64, 90}));
    all.push_back(zone_setting(
        "max_elevation_m", &PatchworkConfig::max_elevation_m, zone,
        not_below(PatchworkConfig{}.max_elevation_m[zone], {0.523, 0.7246, 0.872, 1.0, 1.118, 1.2})));
  }
  all.push_back(
      setting("low_cut_below_ground_m", &PatchworkConfig::low_cut_below_ground_m, {1.4, 2, 2.5, 3}));
  all.push_back(setting("min_points", &PatchworkConfig::min_points, {3, 5, 7, 10, 15}));
  all.push_back(setting("lowest_points", &PatchworkConfig::lowest_points, {5, 10, 20, 30, 50}));
  all.push_back(setting("lowest_margin", &PatchworkConfig::lowest_margin, {1.05, 1.1, 1.2, 1.3, 1.5}));
  all.push_back(
      setting("seed_height_m", &PatchworkConfig::seed_height_m, {0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6}));
  all.push_back(setting("ground_thickness_m", &PatchworkConfig::ground_thickness_m,
                        {0.06, 0.075, 0.09, 0.1, 0.125, 0.15, 0.2}));
  all.push_back(setting("iterations", &PatchworkConfig::iterations, {2, 3}));
  all.push_back(
      setting("min_uprightness", &PatchworkConfig::min_uprightness, {0.707, 0.8, 0.9, 0.94, 0.97, 0.985}));
  return all;
}

/// What a sweep is to the search: where its returns are, and what they hit.
std::unique_ptr<Sweep> kept(const Sweep& sweep) {
  auto copy = std::make_unique<Sweep>(sweep.size);
  copy->size = sweep.size;
  copy->header = sweep.header;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    copy->x_m[i] = sweep.x_m[i], copy->y_m[i] = sweep.y_m[i], copy->z_m[i] = sweep.z_m[i];
    copy->label[i] = sweep.label[i];
  }
  return copy;
}

using Sweeps = std::vector<std::unique_ptr<Sweep>>;

void add_drives(SimulatedWorld world, Sweeps& sweeps) {
  for (const int seed : kSeeds) {
    Config config;
    config.simulator.world = world;
    config.simulator.seed = seed;
    config.simulator.seconds = 3.0;
    config.simulator.start_speed_m_s = 10.0;
    SimulatorSource source(config.simulator, config.hdl64, config.mount);
    SweepReader reader(config, source, source.calibration());
    for (int i = 0; const Sweep* const sweep = reader.next(); ++i)
      if (i % kEvery == kFirst && sweep->header.is_posed()) sweeps.push_back(kept(*sweep));
  }
}

double mean_f1(const Sweeps& sweeps, const PatchworkConfig& settings_tried) {
  GroundConfig config;
  config.method = "patchwork-hdl64";
  config.patchwork_hdl64 = settings_tried;
  double sum = 0.0;
  for (const auto& sweep : sweeps) {
    const auto segmenter = ground::make_segmenter(config, Mount{}, sweep->capacity());
    segmenter->begin(*sweep);
    segmenter->finish(*sweep);
    for (const auto protocol :
         {evaluation::GroundProtocol::kPatchwork, evaluation::GroundProtocol::kPatchworkPlusPlus})
      sum += 0.5 * ground_score(count_ground(protocol, *sweep)).f1;
  }
  return sum / static_cast<double>(sweeps.size());
}

void print(const PatchworkConfig& c) {
  const auto list = [](const char* name, const std::array<double, 4>& v) {
    std::printf("%s = [%g, %g, %g, %g]\n", name, v[0], v[1], v[2], v[3]);
  };
  std::printf("\n[ground.patchwork_hdl64]\n");
  list("zone_rings", c.zone_rings);
  list("zone_sectors", c.zone_sectors);
  std::printf(
      "low_cut_below_ground_m = %g\nmin_points = %d\nlowest_points = %d\nlowest_margin = %g\n"
      "seed_height_m = %g\nground_thickness_m = %g\niterations = %d\nmin_uprightness = %g\n",
      c.low_cut_below_ground_m, c.min_points, c.lowest_points, c.lowest_margin, c.seed_height_m,
      c.ground_thickness_m, c.iterations, c.min_uprightness);
  list("max_elevation_m", c.max_elevation_m);
  list("max_surface_variation", c.max_surface_variation);
}

void search() {
  Sweeps sweeps;
  add_drives(SimulatedWorld::kUrban, sweeps);
  const std::size_t num_streets = sweeps.size();
  add_drives(SimulatedWorld::kRural, sweeps);
  PatchworkConfig best;
  // In bins smaller than the paper's a car's roof is alone, and flat: flatness excuses no elevation.
  best.max_surface_variation = {};
  double best_f1 = mean_f1(sweeps, best);
  std::printf("%zu sweeps of streets, %zu of rough country; the paper's settings: F1 %.3f %%\n", num_streets,
              sweeps.size() - num_streets, 100.0 * best_f1);
  for (int pass = 1; pass <= kPasses; ++pass) {
    for (const Setting& setting : settings()) {
      for (const double value : setting.values) {
        PatchworkConfig tried = best;
        setting.set(tried, value);
        const double f1 = mean_f1(sweeps, tried);
        if (!(f1 > best_f1)) continue;
        best = tried;
        best_f1 = f1;
        std::printf("pass %d: %s = %g: F1 %.3f %%\n", pass, setting.name.c_str(), value, 100.0 * f1);
        std::fflush(stdout);
      }
    }
  }
  print(best);
}

}  // namespace

int main() try {
  search();
  return 0;
} catch (const Error& e) {
  std::fprintf(stderr, "patchwork_search: %s\n", e.what());
  return 1;
}
