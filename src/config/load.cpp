// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/load.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>

#include "pago/core/error.hpp"
#include "settings.hpp"
#include "toml.hpp"

namespace pago {
namespace {

using config::Entry;
using config::Setting;
using config::Settings;

std::string read(const std::filesystem::path& file) {
  std::error_code unknown;
  if (std::filesystem::is_directory(file, unknown))
    throw Error(file.string(), "is a folder, not a TOML file");
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw Error(file.string(), std::string("cannot be read: ") + std::strerror(errno));
  return text;
}

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n";
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

std::string shortened(std::string text) {
  constexpr std::size_t kLongest = 80;
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  return text;
}

[[noreturn]] void refuse_key(const Settings& settings, const Entry& entry, const std::string& where) {
  const bool is_table = std::holds_alternative<config::TableValue>(entry.value);
  const std::string nearest = settings.nearest(entry.key);
  throw Error(where, (is_table ? "unknown section " : "unknown key ") + entry.key,
              nearest.empty() ? "" : "did you mean " + nearest + "?");
}

constexpr std::string_view kPreset = "preset";

void apply(const Settings& settings, const Entry& entry, const std::string& where) {
  if (settings.has_section(entry.key)) {
    if (std::holds_alternative<config::TableValue>(entry.value)) return;
    throw Error(where, entry.key + " is a section, not a setting", "write [" + entry.key + "]");
  }
  const Setting* setting = settings.find(entry.key);
  if (setting == nullptr) refuse_key(settings, entry, where);
  if (assign(*setting, entry.value)) return;
  throw Error(where,
              entry.key + " must be " + expectation(*setting) + ", is " + shortened(to_text(entry.value)));
}

/// `key=value`, the value read as the setting's type asks: text may come without quotes.
Entry parse_assignment(const Settings& settings, std::string_view assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string_view::npos) throw Error(std::string(assignment), "is not of the form key=value");
  Entry entry{trimmed(assignment.substr(0, equals)), {}, 1};
  const std::string text = trimmed(assignment.substr(equals + 1));
  entry.value = config::parse_value(text);
  const Setting* setting = settings.find(entry.key);
  const bool takes_text = setting != nullptr && std::holds_alternative<std::string>(value_of(*setting));
  if (takes_text && !text.starts_with('"') && !text.starts_with('\'')) entry.value = text;
  return entry;
}

}  // namespace

Config load_config(const std::filesystem::path& file) {
  Config config;
  load_config(config, file);
  return config;
}

void load_config(Config& config, const std::filesystem::path& file) {
  apply_toml(config, read(file), file.string());
}

void apply_toml(Config& config, std::string_view text, const std::string& name) {
  Config changed = config;
  const Settings settings = config::settings_of(changed);
  std::vector<Entry> entries = config::parse_toml(text, name);
  std::stable_partition(entries.begin(), entries.end(),
                        [](const Entry& entry) { return entry.key == kPreset; });
  for (const Entry& entry : entries) {
    apply(settings, entry, name + ":" + std::to_string(entry.line));
    if (entry.key == kPreset) apply_preset(changed, changed.preset);
  }
  config = changed;
}

void set(Config& config, std::string_view assignment) {
  const Settings settings = config::settings_of(config);
  const Entry entry = parse_assignment(settings, assignment);
  apply(settings, entry, std::string(assignment));
  if (entry.key == kPreset) apply_preset(config, config.preset);
}

}  // namespace pago
