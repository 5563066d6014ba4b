// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

namespace pago::output {

struct ResultsFolder {
  std::filesystem::path folder;  ///< empty, of this run alone
  std::filesystem::path latest;  ///< the link to it, beside it
  std::string complaint;         ///< empty, or why `latest` could not be set; the run can go on
};

/// [set-up] Makes PARENT/<local time>, e.g. results/2026-03-14_15-09-26, and lets PARENT/latest lead to it.
/// Two runs in the same second get different folders (suffix _2, _3, ...), also when two processes race;
/// nothing that exists is written over, but for a `latest` that is a link. Error when no folder can be made.
ResultsFolder create_results_folder(
    const std::filesystem::path& parent,
    std::chrono::system_clock::time_point now = std::chrono::system_clock::now());

}  // namespace pago::output
