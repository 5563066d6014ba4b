// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "settings.hpp"
#include "source.hpp"

namespace CLI {
class App;
}

namespace pago::app {

/// What `pago run` is asked for.
struct RunOptions {
  std::string source, output, calibration, ground, record, as_recorded;
  PartOptions part;
  bool is_realtime = false;
  std::optional<double> speed;
  SettingsOptions settings;

  /// A capture is replayed as if the sensor were live.
  bool is_paced() const { return is_realtime || speed.has_value(); }
};
/// All but the source.
void add_run_options(CLI::App& command, RunOptions& options);

/// What a run came to, and where it left its files.
struct RunOutcome {
  int exit_code = 0;
  std::string folder;
};
/// Runs to the end of the source or until the user stops it; says on the terminal what came out. Error for
/// what is refused before work begins.
RunOutcome run_source(const RunOptions& options);

}  // namespace pago::app
