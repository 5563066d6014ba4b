// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "pago/output/control.hpp"

namespace pago::app {

namespace {

struct CtlOptions {
  std::string request, socket;
};

int ctl_command(const CtlOptions& options) {
  const std::string answer = options.socket.empty() ? output::ask_usual(options.request)
                                                    : output::ask(options.socket, options.request);
  const auto json = nlohmann::ordered_json::parse(answer, nullptr, /*allow_exceptions=*/false);
  if (json.contains("error")) {
    std::cerr << "pago: " << json["error"].get<std::string>() << '\n';
    return 1;
  }
  std::cout << (json.is_discarded() ? answer : json.dump(2)) << '\n';
  return 0;
}

}  // namespace

void add_ctl_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("ctl", "talk to a pago that reads a live sensor");
  const auto options = std::make_shared<CtlOptions>();
  command
      .add_option("request", options->request,
                  "status (how it goes), save (everything so far to the disk), reset (odometry begins anew), "
                  "trace (the last sweeps' stages as a file)")
      ->check(CLI::IsMember({"status", "save", "reset", "trace"}).description(""))
      ->type_name("REQUEST")
      ->required();
  command.add_option("--socket", options->socket, "the run's control.socket, if it is not the usual one")
      ->type_name("PATH");
  command.callback([&action, options] { action = [options] { return ctl_command(*options); }; });
}

}  // namespace pago::app
