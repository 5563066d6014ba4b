// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/load.hpp"
#include "settings.hpp"

namespace pago {
namespace {

using config::Section;
using config::Setting;
using config::Settings;

std::string default_text(const Settings& defaults, const Setting& setting) {
  return to_text(value_of(*defaults.find(setting.key)));
}

std::string toml_setting(const Setting& setting, const Settings& defaults) {
  return "# " + setting.meaning + "\n# " + expectation(setting) + "; default " +
         default_text(defaults, setting) + "\n" + std::string(setting.leaf()) + " = " +
         to_text(value_of(setting)) + "\n";
}

/// A section's settings must stand together in TOML, whatever subsections lie between them in describe().
template <typename Write>
std::string each_of_section(const Settings& settings, std::size_t section, Write write) {
  std::string out;
  for (const Setting& setting : settings.list)
    if (setting.section == section) out += write(setting);
  return out;
}

std::string table_cell(std::string_view text) {
  std::string out;
  for (const char letter : text) out += letter == '|' ? std::string("\\|") : std::string(1, letter);
  return out;
}

std::string markdown_row(const Setting& setting) {
  return "| `" + std::string(setting.leaf()) + "` | " + table_cell(setting.meaning) + " | " +
         table_cell(expectation(setting)) + " | `" + table_cell(to_text(value_of(setting))) + "` |\n";
}

}  // namespace

std::string dump_toml(const Config& config) {
  Config shown = config, plain;
  const Settings settings = config::settings_of(shown), defaults = config::settings_of(plain);
  std::string out = "# PaGO's settings. A file needs to name only those that differ from their default.\n";
  for (std::size_t i = 0; i < settings.sections.size(); ++i) {
    const Section& section = settings.sections[i];
    if (!section.key.empty()) out += "\n# " + section.meaning + "\n[" + section.key + "]\n";
    out += each_of_section(settings, i, [&](const Setting& s) { return toml_setting(s, defaults); });
  }
  return out;
}

std::string describe_markdown() {
  Config plain;
  const Settings settings = config::settings_of(plain);
  std::string out;
  for (std::size_t i = 0; i < settings.sections.size(); ++i) {
    const std::string rows = each_of_section(settings, i, markdown_row);
    if (rows.empty()) continue;
    const Section& section = settings.sections[i];
    out += (out.empty() ? "" : "\n");
    if (!section.key.empty()) out += "### `[" + section.key + "]`: " + section.meaning + "\n\n";
    out += "| key | meaning | may be | default |\n|---|---|---|---|\n" + rows;
  }
  return out;
}

}  // namespace pago
