// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/scan_page.hpp"

#include <cmath>
#include <functional>

#include "pago/core/text.hpp"
#include "pago/page/chart.hpp"
#include "pago/page/html.hpp"

namespace pago::report {
namespace {

using evaluation::kIncidenceBins;
using evaluation::kPatchBins;
using evaluation::kRangeBins;
using evaluation::ScannedDrive;
using evaluation::ScanStatistics;
using Drives = std::vector<ScannedDrive>;
/// A drive's value in a bin; not finite where there is none.
using Value = std::function<double(const ScanStatistics&, std::size_t bin)>;

double share_percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? std::nan("") : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

/// A line per drive through the bins' middles.
std::string lines(const Drives& drives, page::Chart chart, const evaluation::Bins& bins, const Value& value) {
  for (std::size_t i = 0; i < drives.size(); ++i) {
    page::Series series{.name = drives[i].source, .x = {}, .y = {}, .colour = i};
    for (std::size_t bin = 0; bin < bins.count; ++bin) {
      series.x.push_back(bins.from(bin) + 0.5 * bins.width);
      series.y.push_back(value(drives[i].statistics, bin));
    }
    chart.series.push_back(std::move(series));
  }
  return figure(chart);
}

page::Chart chart_of(const char* title, const char* caption, const char* x, const char* y) {
  return {.title = title, .caption = caption, .x = {.label = x}, .y = {.label = y}, .series = {}};
}

std::string where_returns_are(const Drives& drives) {
  constexpr evaluation::Bins kRings{kNumRings, 1.0};
  return lines(drives,
               chart_of("Returns per ring", "Some 2,080 firings at 10 Hz; the sky and a roof return nothing.",
                        "ring, 0 the lowest", "returns per sweep"),
               kRings,
               [](const ScanStatistics& s, std::size_t ring) {
                 return static_cast<double>(s.of_ring[ring]) / static_cast<double>(s.sweeps);
               }) +
         lines(drives,
               chart_of("Ranges", "What kind of place it is, and how far the sensor sees.", "range, m",
                        "% of returns per 2 m"),
               kRangeBins, [](const ScanStatistics& s, std::size_t bin) {
                 return share_percent(s.of_range[bin], s.returns);
               });
}

std::string how_ground_lies(const Drives& drives) {
  return lines(drives, chart_of("Ground by range", "As the ground method says.", "range, m", "% of returns"),
               kRangeBins,
               [](const ScanStatistics& s, std::size_t bin) {
                 return s.of_range[bin] < 100 * s.sweeps
                            ? std::nan("")
                            : share_percent(s.ground_of_range[bin], s.of_range[bin]);
               }) +
         lines(
             drives,
             chart_of("Ground from its planes",
                      "Median over patches with a side of a fifth of the range: noise, laser against laser, "
                      "and the ground's own roughness.",
                      "range, m", "rms distance, mm"),
             kPatchBins, [](const ScanStatistics& s, std::size_t bin) {
               return 1e3 * evaluation::median_value(s.patch_rms_m[bin]);
             });
}

std::string how_they_scatter(const Drives& drives) {
  return lines(drives,
               chart_of("Range noise by incidence", "A range against those of the firings before and after.",
                        "incidence, degrees (0 square on)", "standard deviation, mm"),
               kIncidenceBins,
               [](const ScanStatistics& s, std::size_t bin) {
                 return 1e3 * evaluation::range_noise_m(s.surfaces[bin]);
               }) +
         lines(drives,
               chart_of("Distance from the sweep before", "Of returns from the planes of the sweep before.",
                        "distance, mm", "% of returns up to it"),
               {100, 1.0}, [](const ScanStatistics& s, std::size_t mm) {
                 std::uint64_t up_to = 0, all = 0;
                 for (std::size_t i = 0; i < s.apart.size(); ++i) {
                   all += s.apart[i];
                   if (evaluation::kApartBins.from(i) * 1e3 <= static_cast<double>(mm)) up_to += s.apart[i];
                 }
                 return share_percent(up_to, all);
               });
}

/// Intensities in sixteens, as shares.
std::string intensities(const Drives& drives,
                        const char* title,
                        std::array<std::uint64_t, 256> ScanStatistics::*counts) {
  static constexpr evaluation::Bins kSixteens{16, 16.0};
  return lines(drives, chart_of(title, "", "intensity, 0 to 255", "% of them per 16"), kSixteens,
               [counts](const ScanStatistics& s, std::size_t bin) {
                 std::uint64_t in_bin = 0, all = 0;
                 for (std::size_t i = 0; i < 256; ++i) {
                   all += (s.*counts)[i];
                   if (kSixteens.of(static_cast<double>(i)) == bin) in_bin += (s.*counts)[i];
                 }
                 return share_percent(in_bin, all);
               });
}

std::string what_comes_back(const Drives& drives) {
  return lines(drives,
               chart_of("Dropout by incidence",
                        "Firings without a return among those at surfaces that are flat around them.",
                        "incidence, degrees (0 square on)", "% of firings"),
               kIncidenceBins,
               [](const ScanStatistics& s, std::size_t bin) {
                 return evaluation::dropout_percent(s.surfaces[bin]);
               }) +
         intensities(drives, "Intensity of ground", &ScanStatistics::ground_intensity) +
         intensities(drives, "Intensity of all else", &ScanStatistics::other_intensity);
}

std::string table_of(const Drives& drives) {
  page::Table table{{""}, {}};
  for (const ScannedDrive& drive : drives) table.head.push_back(drive.source);
  table.rows.push_back({{"sweeps"}});
  for (const ScannedDrive& drive : drives)
    table.rows.back().push_back({format("%llu", static_cast<unsigned long long>(drive.statistics.sweeps))});
  for (const evaluation::ScanFigure& figure : evaluation::scan_figures()) {
    std::vector<page::Cell> row{{figure.name}};
    for (const ScannedDrive& drive : drives) {
      const double value = figures_of(drive.statistics).*figure.value * figure.scale;
      row.push_back({std::isfinite(value) ? format("%.*f", figure.decimals, value) : "–"});
    }
    table.rows.push_back(std::move(row));
  }
  return page::table(table);
}

}  // namespace

std::string scan_page(const Drives& drives, const std::string& made_by) {
  return page::document(
      {"Drives side by side",
       "What their sweeps look like: where returns come from, how they scatter, which are missing.",
       page::section("Figures", "", table_of(drives)) +
           page::section("Where returns are", "", page::grid(where_returns_are(drives))) +
           page::section("Ground", "", page::grid(how_ground_lies(drives))) +
           page::section("How they scatter", "", page::grid(how_they_scatter(drives))) +
           page::section("What comes back", "", page::grid(what_comes_back(drives))),
       made_by});
}

}  // namespace pago::report
