// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>

#include "pago/config/describe.hpp"

namespace pago {

struct Config;

/// Named sets of settings. docs/presets.md says what is in them and why. With those of the paper odometry and
/// mapping allocate while they run: for studies, not for robots.
enum class Preset {
  kDefault,    ///< PaGO's own
  kPaperCode,  ///< what PaGO-LOAM's code does; only its bounds of indices and its casts are mended
  kPaperText   ///< what the texts of LeGO-LOAM and PaGO-LOAM say
};

constexpr auto preset_choices() {
  return choices(std::pair{"default", Preset::kDefault}, std::pair{"paper-code", Preset::kPaperCode},
                 std::pair{"paper-text", Preset::kPaperText});
}

/// [set-up] Changes the settings that the preset names; kDefault none. Other settings stay as they are, so it
/// is applied first. In a settings file `preset = "paper-code"` comes first wherever it stands; as `--set` it
/// is applied in its turn.
void apply_preset(Config& config, Preset preset);

/// [set-up] By its name; throws Error with the names that there are.
Preset preset_of(std::string_view name);

/// What the preset sets and why, as sections of TOML; those of paper-text follow those of paper-code.
std::string preset_toml(Preset preset);

}  // namespace pago
