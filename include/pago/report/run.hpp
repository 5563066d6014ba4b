// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/evaluation/evaluation.hpp"
#include "pago/output/run_files.hpp"

/// Pages for people: what evaluation and output measured, as text, tables and figures. Each page is one file
/// (page/html.hpp). The sections are there one by one for other pages, those of the study and of
/// `pago segment`. [set-up] everything here allocates. The same data give the same bytes.
namespace pago::report {

/// One of the things that a page shows side by side.
struct ScoredRun {
  std::string name;
  evaluation::Evaluation score;
};
struct TimedRun {
  std::string name;
  output::RunFiles files;
};

/// What tells paths apart: leading and trailing parts that all have in common are left out.
std::vector<std::string> short_names(const std::vector<std::string>& paths);

}  // namespace pago::report
