// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pago/config/config.hpp"

namespace CLI {
class App;
}

namespace pago::app {

/// The options by which every command that works with settings takes them; later ones win.
struct SettingsOptions {
  std::string preset, file;
  std::vector<std::string> assignments;

  void add_to(CLI::App& command);
  /// The defaults, changed by the preset, the file and the assignments, in this order. Throws Error; not
  /// validated yet.
  Config load() const;
};

/// The options by which a command takes a part of a capture only.
struct PartOptions {
  std::optional<double> start_s, duration_s;

  void add_to(CLI::App& command);
  void apply(Config& config) const;
  bool is_given() const noexcept { return start_s || duration_s; }
};

}  // namespace pago::app
