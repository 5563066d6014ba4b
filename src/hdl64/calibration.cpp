// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/calibration.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <numeric>

#include "calibration_file.hpp"
#include "pago/core/error.hpp"
#include "pago/hdl64/packet.hpp"

namespace pago::hdl64 {
namespace {

/// Whether a file must give a figure (in the order of kLimits).
struct FigureRule {
  bool required;     ///< by every laser
  bool all_or_none;  ///< a file that gives it for some lasers only is cut short
};
constexpr std::array<FigureRule, kMinIntensity> kRules{{
    {true, true},
    {true, true},
    {true, true},
    {false, false},
    {false, false},
    {false, true},
    {false, true},
    {false, true},
    {false, true},
}};
static_assert(kRules.size() == kLimits.size());
constexpr std::size_t kMaxFileBytes = 4 << 20;  ///< real ones have 20 to 50 kB

std::string short_number(double value) {
  std::array<char, 32> text{};
  const int size = std::snprintf(text.data(), text.size(), "%.6g", value);
  return {text.data(), static_cast<std::size_t>(size)};
}

std::string read_text(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path)) throw Error(path.string(), "is a folder, not a calibration file");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw Error(path.string(), "cannot be opened", "is the path of the calibration file right?");
  std::string text(kMaxFileBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (text.size() > kMaxFileBytes) throw Error(path.string(), "not a calibration: larger than 4 MiB");
  return text;
}

CalibrationFile read_file(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  const std::size_t start = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
  if (start == std::string::npos) throw Error(path.string(), "the file is empty");
  return text[start] == '<' ? read_db_xml(path.string(), text) : read_ros_yaml(path.string(), text);
}

/// Velodyne's other models, known by their number of lasers and vertical field, degrees.
struct OtherSensor {
  const char* name;
  std::size_t lasers;
  double lowest_deg, highest_deg;
};
constexpr std::array kOtherSensors{
    OtherSensor{"a VLP-16", 16, -15.0, 15.0}, OtherSensor{"a VLP-16 Hi-Res", 16, -10.0, 10.0},
    OtherSensor{"an HDL-32E", 32, -30.67, 10.67}, OtherSensor{"a VLP-32C", 32, -25.0, 15.0},
    OtherSensor{"a VLS-128", 128, -25.0, 15.0}};

void refuse_other_sensors(const CalibrationFile& file) {
  std::vector<double> vertical_deg;
  for (const LaserEntry& laser : file.lasers)
    if (laser.enabled && laser.figures[kVertical])
      vertical_deg.push_back(*laser.figures[kVertical] * file.dialect[kVertical].unit / kDegree);
  if (vertical_deg.empty()) return;
  const auto [lowest, highest] = std::minmax_element(vertical_deg.begin(), vertical_deg.end());
  for (const OtherSensor& sensor : kOtherSensors)
    if (vertical_deg.size() == sensor.lasers && std::abs(*lowest - sensor.lowest_deg) < 0.5 &&
        std::abs(*highest - sensor.highest_deg) < 0.5)
      throw Error(file.name,
                  "is a calibration of " + std::string(sensor.name) + " (" + std::to_string(sensor.lasers) +
                      " lasers), not of an HDL-64E",
                  "give the file that came with this HDL-64E");
}

/// Exactly lasers 0..63, in that order from here on.
void check_ids(CalibrationFile& file) {
  std::stable_sort(file.lasers.begin(), file.lasers.end(),
                   [](const LaserEntry& a, const LaserEntry& b) { return a.id < b.id; });
  for (std::size_t i = 0; i < file.lasers.size(); ++i) {
    const LaserEntry& laser = file.lasers[i];
    if (laser.id < 0 || laser.id >= kLasers)
      throw Error(at_line(file.name, laser.line), "a laser's id must be 0 to 63");
    if (i > 0 && laser.id == file.lasers[i - 1].id)
      throw Error(at_line(file.name, laser.line), "laser " + std::to_string(laser.id) + " is given twice");
  }
  if (file.lasers.size() != kLasers)
    throw Error(file.name, "has " + std::to_string(file.lasers.size()) + " lasers, an HDL-64E has 64",
                "is the file cut short?");
}

void check_presence(const CalibrationFile& file, std::size_t figure, const FigureRule& rule) {
  const auto is_given = [figure](const LaserEntry& laser) { return laser.figures[figure].has_value(); };
  const auto missing = std::find_if_not(file.lasers.begin(), file.lasers.end(), is_given);
  if (missing == file.lasers.end()) return;
  const bool given_elsewhere = std::any_of(file.lasers.begin(), file.lasers.end(), is_given);
  if (rule.required || (rule.all_or_none && given_elsewhere))
    throw Error(at_line(file.name, missing->line),
                "laser " + std::to_string(missing->id) + " has no " + file.dialect[figure].key,
                "is the file cut short?");
}

double checked(
    const CalibrationFile& file, const LaserEntry& laser, std::size_t figure, double min, double max) {
  const double value = laser.figures[figure].value_or(0.0), unit = file.dialect[figure].unit;
  if (value * unit < min || value * unit > max)
    throw Error(at_line(file.name, laser.line), std::string(file.dialect[figure].key) + " of laser " +
                                                    std::to_string(laser.id) + " is " + short_number(value) +
                                                    ", must be within [" + short_number(min / unit) + ", " +
                                                    short_number(max / unit) + "]");
  return value * unit;
}

void convert_near_point(const CalibrationFile& file, const LaserEntry& entry, LaserCalibration& laser) {
  fill_near_point(laser);
  for (const Figure figure : {kDistanceX, kDistanceY})
    if (std::abs(laser.*kLimits[figure].member - laser.distance_m) >= kMaxNearDifference_m)
      throw Error(at_line(file.name, entry.line),
                  std::string(file.dialect[figure].key) + " of laser " + std::to_string(entry.id) +
                      " is 0.2 m or more off its " + file.dialect[kDistance].key);
}

void convert_intensities(const CalibrationFile& file, const LaserEntry& entry, LaserCalibration& laser) {
  laser.min_intensity = static_cast<std::uint8_t>(std::lround(checked(file, entry, kMinIntensity, 0, 255)));
  if (entry.figures[kMaxIntensity])
    laser.max_intensity = static_cast<std::uint8_t>(std::lround(checked(file, entry, kMaxIntensity, 0, 255)));
  if (laser.min_intensity > laser.max_intensity)
    throw Error(at_line(file.name, entry.line),
                "laser " + std::to_string(entry.id) + " has its minimum intensity above its maximum");
}

LaserCalibration convert(const CalibrationFile& file, const LaserEntry& entry) {
  LaserCalibration laser;
  for (std::size_t figure = 0; figure < kLimits.size(); ++figure)
    laser.*kLimits[figure].member = checked(file, entry, figure, kLimits[figure].min, kLimits[figure].max);
  convert_near_point(file, entry, laser);
  convert_intensities(file, entry, laser);
  laser.enabled = entry.enabled;
  return laser;
}

double checked_lsb_m(const CalibrationFile& file) {
  const double lsb_m = file.distance_lsb_m.value_or(kDistanceLsb_m);
  if (std::abs(lsb_m - kDistanceLsb_m) > 1e-6)
    throw Error(file.name, "a distance step of " + short_number(lsb_m) + " m, an HDL-64E has 0.002 m");
  return lsb_m;
}

}  // namespace

std::optional<double> parse_number(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return std::nullopt;
  text = text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string in_quotes(std::string_view text) {
  std::string shown(text.substr(0, 24));
  std::replace_if(
      shown.begin(), shown.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + shown + (text.size() > shown.size() ? "...'" : "'");
}

std::string at_line(const std::string& name, int line) {
  return line > 0 ? name + ":" + std::to_string(line) : name;
}

std::array<std::uint8_t, 64> rank_rings(const std::array<LaserCalibration, 64>& lasers) noexcept {
  std::array<std::uint8_t, 64> order{};
  std::iota(order.begin(), order.end(), std::uint8_t{0});
  std::sort(order.begin(), order.end(), [&lasers](std::uint8_t a, std::uint8_t b) {
    return lasers[a].vertical_rad != lasers[b].vertical_rad ? lasers[a].vertical_rad < lasers[b].vertical_rad
                                                            : a < b;
  });
  std::array<std::uint8_t, 64> ring_of_laser{};
  for (std::size_t ring = 0; ring < order.size(); ++ring)
    ring_of_laser[order[ring]] = static_cast<std::uint8_t>(ring);
  return ring_of_laser;
}

Calibration load_calibration(const std::filesystem::path& path, VerticalOffset vertical_offset) {
  CalibrationFile file = read_file(path);
  refuse_other_sensors(file);
  check_ids(file);
  for (std::size_t figure = 0; figure < kRules.size(); ++figure) check_presence(file, figure, kRules[figure]);

  Calibration calibration;
  calibration.distance_lsb_m = checked_lsb_m(file);
  calibration.vertical_offset = vertical_offset;
  calibration.origin = path.string();
  for (std::size_t i = 0; i < kLasers; ++i) {
    const LaserCalibration laser = convert(file, file.lasers[i]);
    calibration.lasers[i] = laser;
    calibration.two_point |= laser.distance_x_m != laser.distance_m || laser.distance_y_m != laser.distance_m;
  }
  calibration.ring_of_laser = rank_rings(calibration.lasers);
  return calibration;
}

}  // namespace pago::hdl64
