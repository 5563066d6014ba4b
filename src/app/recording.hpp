// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/output/run_report.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "source.hpp"

namespace pago::app {

/// What run.json and the summary tell of a run that has ended.
output::RunReport report_of(const RunSummary& summary,
                            const std::string& source,
                            const Config& config,
                            bool has_packets,
                            double wall_s);

/// The same of one that goes on: what is known by now.
output::RunReport report_so_far(const IngestStatus& status,
                                const output::RunTotals& totals,
                                const std::string& source,
                                const Config& config,
                                double wall_s);

/// What a user should know about a run that went through.
std::vector<std::string> doubts(const RunSummary& summary,
                                const output::RunTotals& totals,
                                const OpenSource& source);

/// A stream that gave nothing is bad input; a run that broke off half-way, or lost count, has failed.
int exit_code(const RunSummary& summary, const output::RunTotals& totals, bool is_recorded, bool is_live);

}  // namespace pago::app
