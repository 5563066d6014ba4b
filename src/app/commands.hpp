// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace pago::app {

/// What the command line asks for; returns the exit code. Runs after parsing, so that a mistake anywhere on
/// the command line is found before any work starts.
using Action = std::function<int()>;

/// Each adds one subcommand and, when it is chosen, sets `action`.
void add_run_command(CLI::App& program, Action& action);
void add_inspect_command(CLI::App& program, Action& action);
void add_record_command(CLI::App& program, Action& action);
void add_segment_command(CLI::App& program, Action& action);
void add_evaluate_command(CLI::App& program, Action& action);
void add_profile_command(CLI::App& program, Action& action);
void add_baseline_command(CLI::App& program, Action& action);
void add_compare_command(CLI::App& program, Action& action);
void add_config_command(CLI::App& program, Action& action);
void add_play_command(CLI::App& program, Action& action);
void add_ctl_command(CLI::App& program, Action& action);
void add_doctor_command(CLI::App& program, Action& action);
void add_demo_command(CLI::App& program, Action& action);      // where the simulator is built in
void add_simulate_command(CLI::App& program, Action& action);  // where the simulator is built in

}  // namespace pago::app
