// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/core/text.hpp"
#include "pago/platform/doctor.hpp"

namespace pago::app {

namespace {

using platform::Finding;
using platform::Verdict;

void print(const std::vector<Finding>& findings) {
  for (const Finding& finding : findings) {
    const char* const mark = finding.verdict == Verdict::kGood            ? "ok  "
                             : finding.verdict == Verdict::kCouldBeBetter ? "  ~ "
                                                                          : "BAD ";
    std::cout << mark << format("%-20s", finding.what.c_str()) << finding.found << '\n';
    if (!finding.fix.empty()) std::cout << std::string(24, ' ') << "-> " << finding.fix << '\n';
  }
}

bool has_bad(const std::vector<Finding>& findings) {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.verdict == Verdict::kBad; });
}

int doctor_command(double seconds) {
  std::vector<Finding> findings = platform::examine_host();
  for (const Finding& finding : platform::examine_process()) findings.push_back(finding);
  print(findings);
  if (isatty(STDERR_FILENO) != 0) std::cerr << "measuring timers for " << seconds << " s ...\r";
  const std::vector<Finding> pulse = platform::judge(platform::feel_pulse(seconds));
  print(pulse);
  return has_bad(findings) || has_bad(pulse) ? 1 : 0;
}

}  // namespace

void add_doctor_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "doctor", "is this machine ready for real time? Each finding with its fix; exit code 1 if one is bad");
  const auto seconds = std::make_shared<double>(10.0);
  command.add_option("--seconds", *seconds, "how long timers are measured; default: 10")
      ->check(CLI::Range(0.1, 3600.0).description(""))
      ->type_name("S");
  command.callback([&action, seconds] { action = [seconds] { return doctor_command(*seconds); }; });
}

}  // namespace pago::app
