// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "pago/config/config.hpp"

/// Settings from TOML files and from the command line. A file names only what differs from the defaults.
///
/// Everything here is [set-up] and throws Error: an unknown key (with the nearest known one), a value of the
/// wrong type, out of range or not finite, or text that is no TOML. The message is one line with file and
/// line, key, what the value must be, and what it is:
///
///   drive.toml:3: hdl64.min_range_m must be a number from 0 to 10, is -3
///
/// A whole number will do where a number is expected, but not the reverse. When a function throws, the Config
/// that it was given is as before.
namespace pago {

/// The defaults, changed by a file. Cross-field rules are not checked: see validate().
Config load_config(const std::filesystem::path& file);
/// `config`, changed by a file.
void load_config(Config& config, const std::filesystem::path& file);

/// Changes the settings that `text` names, a preset's (config/preset.hpp) first; `name` stands for it in
/// messages.
void apply_toml(Config& config, std::string_view text, const std::string& name);

/// Changes one setting: "ground.method=lego", "mount.height_m=1.9". The value is written as in TOML; the
/// quotes around text may be left out.
void set(Config& config, std::string_view assignment);

/// Refuses a configuration that cannot work: a field out of its range (it may have been set by code), or
/// fields that contradict each other. To be called after the last change.
void validate(const Config& config);

/// A file with every setting: its meaning, what it may be, its default, its value here. Loading it gives the
/// same Config back.
std::string dump_toml(const Config& config);

/// The same list as Markdown tables, one for each section, with the defaults.
std::string describe_markdown();

}  // namespace pago
