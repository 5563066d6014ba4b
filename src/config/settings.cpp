// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "settings.hpp"

#include <algorithm>
#include <numeric>

namespace pago::config {
namespace {

/// Levenshtein's distance: letters to insert, delete or replace.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row.back();
}

std::string_view leaf_of(std::string_view key) {
  return key.substr(key.rfind('.') + 1);
}

/// How unlike the two keys are: 0 the same, 1 nothing in common. A right name in the wrong section is close.
double unlikeness(std::string_view key, std::string_view known) {
  const auto relative = [](std::string_view a, std::string_view b) {
    return static_cast<double>(edit_distance(a, b)) / static_cast<double>(std::max(a.size(), b.size()));
  };
  constexpr double kWrongSection = 0.1;
  return std::min(relative(key, known), relative(leaf_of(key), leaf_of(known)) + kWrongSection);
}

}  // namespace

const Setting* Settings::find(std::string_view key) const {
  const auto found = std::ranges::find(list, key, &Setting::key);
  return found == list.end() ? nullptr : &*found;
}

bool Settings::has_section(std::string_view key) const {
  return std::ranges::find(sections, key, &Section::key) != sections.end();
}

std::string Settings::nearest(std::string_view key) const {
  constexpr double kTooUnlike = 0.4;
  double least = kTooUnlike;
  std::string best;
  const auto consider = [&](const std::string& known) {
    const double now = unlikeness(key, known);
    if (now >= least) return;
    least = now;
    best = known;
  };
  for (const Setting& known : list) consider(known.key);
  for (const Section& known : sections) consider(known.key);
  return best;
}

std::string Collector::full_key(std::string_view key) const {
  const std::string& section = out_.sections[section_].key;
  return section.empty() ? std::string(key) : section + "." + std::string(key);
}

void Collector::add(std::string_view key, Slot slot, Within bounds, std::string_view meaning) {
  out_.list.push_back({full_key(key), std::string(meaning), std::move(slot), bounds, section_});
}

}  // namespace pago::config
