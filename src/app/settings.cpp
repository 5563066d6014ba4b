// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "settings.hpp"

#include <CLI/CLI.hpp>

#include "pago/config/load.hpp"
#include "pago/core/error.hpp"

namespace pago::app {

void SettingsOptions::add_to(CLI::App& command) {
  command
      .add_option("--preset", preset,
                  "a named set of settings, which file and --set may change: default, paper-code, paper-text")
      ->type_name("NAME");
  command.add_option("--config", file, "settings file (TOML); `pago config` prints one")->type_name("FILE");
  command
      .add_option("--set", assignments, "change one setting, e.g. --set ground.method=lego; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

Config SettingsOptions::load() const {
  Config config;
  const std::optional<Preset> asked = preset.empty() ? std::nullopt : std::optional(preset_of(preset));
  if (asked) apply_preset(config, *asked);
  if (!file.empty()) {
    load_config(config, file);
    if (asked && config.preset != *asked)
      throw Error(file, "has a preset of its own", "leave out one of the two");
  }
  for (const std::string& assignment : assignments) set(config, assignment);
  return config;
}

void PartOptions::add_to(CLI::App& command) {
  command.add_option("--start", start_s, "of a capture, skip so many seconds at the beginning")
      ->type_name("SECONDS");
  command.add_option("--duration", duration_s, "of a capture, use so many seconds after that; 0: all")
      ->type_name("SECONDS");
}

void PartOptions::apply(Config& config) const {
  if (start_s) config.capture.start_s = *start_s;
  if (duration_s) config.capture.duration_s = *duration_s;
}

}  // namespace pago::app
