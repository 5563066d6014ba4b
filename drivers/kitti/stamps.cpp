// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stamps.hpp"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <optional>
#include <string>

#include "pago/core/error.hpp"
#include "pago/kitti/kitti_source.hpp"

namespace pago::kitti {
namespace {

using Parse = std::optional<std::int64_t> (*)(const std::string& line);

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t\r") == std::string::npos;
}

std::optional<std::int64_t> parse_seconds(const std::string& line) {
  char* end = nullptr;
  const double seconds = std::strtod(line.c_str(), &end);
  const bool is_usable = end != line.c_str() && is_blank(end) && std::abs(seconds) < 1e9;  // false for NaN
  if (!is_usable) return std::nullopt;
  return kKittiEpochNs + std::llround(seconds * 1e9);
}

std::optional<std::int64_t> parse_date(const std::string& line) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, used = 0;
  double second = 0.0;
  const int got = std::sscanf(line.c_str(), "%4d-%2d-%2d %2d:%2d:%lf%n", &year, &month, &day, &hour, &minute,
                              &second, &used);
  const std::chrono::year_month_day date{std::chrono::year{year},
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  const bool is_time = hour >= 0 && hour < 24 && minute >= 0 && minute < 60 && second >= 0.0 && second < 61.0;
  if (got != 6 || !date.ok() || !is_time || !is_blank(line.substr(static_cast<std::size_t>(used))))
    return std::nullopt;
  const std::chrono::nanoseconds midnight = std::chrono::sys_days{date}.time_since_epoch();
  return midnight.count() + (hour * 60 + minute) * 60'000'000'000LL + std::llround(second * 1e9);
}

std::vector<std::int64_t> read(const std::filesystem::path& file, Parse parse, const std::string& expected) {
  std::ifstream in(file);
  if (!in) throw Error(file.string(), "cannot be read", "it holds the scans' stamps");
  std::vector<std::int64_t> stamps_ns;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (is_blank(line)) continue;
    const auto stamp_ns = parse(line);
    if (!stamp_ns)
      throw Error(file.string() + ":" + std::to_string(number), "'" + line + "' is not a stamp",
                  "expected " + expected);
    if (!stamps_ns.empty() && *stamp_ns <= stamps_ns.back())
      throw Error(file.string() + ":" + std::to_string(number),
                  "'" + line + "' is not later than the stamp before it", "stamps of scans must rise");
    stamps_ns.push_back(*stamp_ns);
  }
  return stamps_ns;
}

}  // namespace

std::vector<std::int64_t> read_seconds(const std::filesystem::path& file) {
  return read(file, parse_seconds, "seconds such as 1.037359e-01");
}

std::vector<std::int64_t> read_dates(const std::filesystem::path& file) {
  return read(file, parse_date, "a date such as 2011-09-26 13:02:25.951199337");
}

std::int64_t period_ns(const std::vector<std::int64_t>& stamps_ns, std::size_t i) {
  const std::size_t before = i > 0 ? i - 1 : i;
  const std::size_t after = i + 1 < stamps_ns.size() ? i + 1 : i;
  if (before == after) return kNominalPeriodNs;
  const std::int64_t period =
      (stamps_ns[after] - stamps_ns[before]) / static_cast<std::int64_t>(after - before);
  return period >= 40'000'000 && period <= 250'000'000 ? period : kNominalPeriodNs;
}

}  // namespace pago::kitti
