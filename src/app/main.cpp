// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>

#include "commands.hpp"
#include "pago/core/error.hpp"

namespace {

constexpr int kFailure = 1, kBadInput = 2;

int parse_and_act(int argc, char** argv) {
  CLI::App program("PaGO: LiDAR odometry and mapping for the Velodyne HDL-64E", "pago");
  program.set_version_flag("--version", "pago " PAGO_VERSION);
  program.require_subcommand(0, 1);
  pago::app::Action action;
  pago::app::add_run_command(program, action);
  pago::app::add_inspect_command(program, action);
  pago::app::add_record_command(program, action);
  pago::app::add_segment_command(program, action);
  pago::app::add_evaluate_command(program, action);
  pago::app::add_profile_command(program, action);
  pago::app::add_baseline_command(program, action);
  pago::app::add_compare_command(program, action);
  pago::app::add_play_command(program, action);
  pago::app::add_ctl_command(program, action);
  pago::app::add_doctor_command(program, action);
  pago::app::add_config_command(program, action);
#ifdef PAGO_HAS_SIMULATOR
  pago::app::add_demo_command(program, action);
  pago::app::add_simulate_command(program, action);
#endif
  // Before the options: `pago profil --help` is no wish for this help.
  const auto is_meant = [&](const CLI::App* command) { return argc > 1 && command->get_name() == argv[1]; };
  if (argc > 1 && argv[1][0] != '-' && program.get_subcommands(is_meant).empty()) {
    std::cerr << "pago: there is no command '" << argv[1] << "' (see pago --help)\n";
    return kBadInput;
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return program.exit(wanted);
  } catch (const CLI::ParseError& mistake) {
    std::cerr << "pago: " << mistake.what() << " (see pago --help)\n";
    return kBadInput;
  }
  if (!action) {
    std::cerr << "pago: no command given (see pago --help)\n";
    return kBadInput;
  }
  const int code = action();
  if (std::cout.flush()) return code;
  std::cerr << "pago: standard output cannot be written\n";
  return kFailure;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return parse_and_act(argc, argv);
  } catch (const pago::Error& error) {
    std::cerr << "pago: " << error.what() << '\n';
    return kBadInput;
  } catch (const std::exception& error) {
    std::cerr << "pago: " << error.what() << '\n';
    return kFailure;
  }
}
