// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pago/core/text.hpp"
#include "pago/evaluation/scan_statistics.hpp"

namespace pago::evaluation {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no NaN.
Json json_of(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json ranges_of(const ScanStatistics& s) {
  Json bins = Json::array();
  for (std::size_t i = 0; i < kRangeBins.count; ++i)
    bins.push_back(
        {{"from_m", kRangeBins.from(i)}, {"returns", s.of_range[i]}, {"ground", s.ground_of_range[i]}});
  return bins;
}

Json patches_of(const ScanStatistics& s) {
  Json bins = Json::array();
  for (std::size_t i = 0; i < kPatchBins.count; ++i)
    bins.push_back({{"from_m", kPatchBins.from(i)},
                    {"patches", s.patch_rms_m[i].size()},
                    {"median_rms_m", json_of(median_value(s.patch_rms_m[i]))}});
  return bins;
}

Json surfaces_of(const ScanStatistics& s) {
  Json bins = Json::array();
  for (std::size_t i = 0; i < kIncidenceBins.count; ++i)
    bins.push_back({{"from_deg", kIncidenceBins.from(i)},
                    {"firings", s.surfaces[i].had + s.surfaces[i].lost},
                    {"lost", s.surfaces[i].lost},
                    {"dropout_percent", json_of(dropout_percent(s.surfaces[i]))},
                    {"range_noise_m", json_of(range_noise_m(s.surfaces[i]))}});
  return bins;
}

Json json_of(const ScannedDrive& drive) {
  const ScanStatistics& s = drive.statistics;
  const ScanFigures figures = figures_of(s);
  Json values;
  for (const ScanFigure& figure : scan_figures())
    values[figure.key] = json_of(figures.*figure.value * figure.scale);
  return {{"source", drive.source},
          {"sweeps", s.sweeps},
          {"figures", values},
          {"returns_of_ring", s.of_ring},
          {"ranges", ranges_of(s)},
          {"ground_patches", patches_of(s)},
          {"surfaces", surfaces_of(s)},
          {"ground_intensity", s.ground_intensity},
          {"other_intensity", s.other_intensity}};
}

std::string cell(double value, int decimals) {
  return std::isfinite(value) ? format("%12.*f", decimals, value) : format("%12s", "n/a");
}

}  // namespace

const std::vector<ScanFigure>& scan_figures() {
  using F = ScanFigures;
  static const std::vector<ScanFigure> kFigures{
      {"returns per sweep", "returns_per_sweep", &F::returns_per_sweep, 1.0, 0},
      {"ten lowest rings, % of returns", "lowest_rings_percent", &F::lowest_rings_percent, 1.0, 1},
      {"range, median, m", "median_range_m", &F::median_range_m, 1.0, 1},
      {"beyond 30 m, % of returns", "beyond_30_m_percent", &F::beyond_30_percent, 1.0, 1},
      {"ground, % of returns", "ground_percent", &F::ground_percent, 1.0, 1},
      {"ground from its planes, 5 to 10 m, mm", "near_residual_mm", &F::near_residual_m, 1e3, 1},
      {"ground from its planes, 15 to 20 m, mm", "far_residual_mm", &F::far_residual_m, 1e3, 1},
      {"range noise below 60 deg, mm", "range_noise_mm", &F::range_noise_m, 1e3, 1},
      {"dropout below 60 deg, %", "dropout_percent", &F::dropout_percent, 1.0, 1},
      {"dropout at 70 to 80 deg, %", "grazing_dropout_percent", &F::grazing_dropout_percent, 1.0, 1},
      {"intensity of ground, median", "ground_intensity", &F::ground_intensity, 1.0, 0},
      {"intensity of all else, median", "other_intensity", &F::other_intensity, 1.0, 0},
      {"from the sweep before, median, mm", "overlap_mm", &F::overlap_m, 1e3, 1},
      {"no surface in the sweep before, %", "unmatched_percent", &F::unmatched_percent, 1.0, 1},
  };
  return kFigures;
}

std::string scan_table(const std::vector<ScannedDrive>& drives) {
  std::string text, head = format("%-40s", "");
  std::vector<ScanFigures> figures;
  for (std::size_t i = 0; i < drives.size(); ++i) {
    const std::string number = format("[%zu]", i + 1);
    text += number + ' ' + drives[i].source +
            format(", %llu sweeps\n", static_cast<unsigned long long>(drives[i].statistics.sweeps));
    head += format("%12s", number.c_str());
    figures.push_back(figures_of(drives[i].statistics));
  }
  text += head + '\n';
  for (const ScanFigure& figure : scan_figures()) {
    text += format("%-40s", figure.name);
    for (const ScanFigures& of : figures) text += cell(of.*figure.value * figure.scale, figure.decimals);
    text += '\n';
  }
  return text;
}

std::string scan_json(const std::vector<ScannedDrive>& drives) {
  Json list = Json::array();
  for (const ScannedDrive& drive : drives) list.push_back(json_of(drive));
  return Json{{"drives", list}}.dump(2) + '\n';
}

}  // namespace pago::evaluation
