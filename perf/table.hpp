// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace pago::perf {

/// Prints a row per benchmark: of each counter that a column names, the median over the repetitions, and
/// beside it the range if the column asks for it. A column without a counter shows the benchmark's label. A
/// cell stays empty where a benchmark has no such counter.
class TableReporter final : public benchmark::BenchmarkReporter {
 public:
  struct Column {
    std::string heading, counter;
    int decimals = 2;
    bool with_range = false;
  };

  TableReporter(std::string row_heading, std::vector<Column> columns);

  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::string row_heading_;
  std::vector<Column> columns_;
};

}  // namespace pago::perf
