// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "pago/report/run.hpp"

namespace pago::report {
namespace {

using Parts = std::vector<std::string>;

Parts parts_of(const std::string& path) {
  Parts parts;
  for (const auto& part : std::filesystem::path(path).lexically_normal())
    if (!part.empty()) parts.push_back(part.string());
  return parts;
}

/// How many parts at the front all have in common, leaving at least one of each.
std::size_t common_front(const std::vector<Parts>& all) {
  std::size_t shortest = all.front().size();
  for (const Parts& parts : all) shortest = std::min(shortest, parts.size());
  std::size_t count = 0;
  const auto is_common = [&](const Parts& parts) { return parts[count] == all.front()[count]; };
  while (count + 1 < shortest && std::all_of(all.begin(), all.end(), is_common)) ++count;
  return count;
}

void drop_front(std::vector<Parts>& all, std::size_t count) {
  for (Parts& parts : all) parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(count));
}

void reverse(std::vector<Parts>& all) {
  for (Parts& parts : all) std::reverse(parts.begin(), parts.end());
}

}  // namespace

std::vector<std::string> short_names(const std::vector<std::string>& paths) {
  std::vector<Parts> all;
  for (const std::string& path : paths) all.push_back(parts_of(path));
  if (all.empty() || std::any_of(all.begin(), all.end(), [](const Parts& parts) { return parts.empty(); }))
    return paths;
  drop_front(all, all.size() == 1 ? all.front().size() - 1 : common_front(all));
  reverse(all);
  drop_front(all, all.size() == 1 ? 0 : common_front(all));
  reverse(all);
  std::vector<std::string> names;
  for (const Parts& parts : all) {
    std::filesystem::path name;
    for (const std::string& part : parts) name /= part;
    names.push_back(name.string());
  }
  return names;
}

}  // namespace pago::report
