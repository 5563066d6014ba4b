// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "settings.hpp"

namespace pago::app {

namespace {

void print_presets() {
  for (const auto& [name, preset] : preset_choices().words)
    std::cout << "# ===== " << name << '\n' << preset_toml(preset) << '\n';
}

}  // namespace

void add_config_command(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("config", "print all settings as a file, with meaning, range, default");
  const auto settings = std::make_shared<SettingsOptions>();
  const auto markdown = std::make_shared<bool>(false), presets = std::make_shared<bool>(false);
  settings->add_to(command);
  command.add_flag("--presets", *presets, "print what each preset sets, and why");
  command.add_flag("--markdown", *markdown, "print the reference tables of the documentation instead");
  command.callback([&action, settings, markdown, presets] {
    action = [settings, markdown, presets] {
      const Config config = settings->load();
      validate(config);
      if (*presets) {
        print_presets();
        return 0;
      }
      std::cout << (*markdown ? describe_markdown() : dump_toml(config));
      return 0;
    };
  });
}

}  // namespace pago::app
