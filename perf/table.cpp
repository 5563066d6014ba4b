// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "table.hpp"

#include <array>
#include <cstdio>

#include "context.hpp"
#include "percentile.hpp"

namespace pago::perf {

namespace {

constexpr int kRowHeadingWidth = 30;

int width(const TableReporter::Column& column) {
  return column.counter.empty() || column.with_range ? 22 : 9;
}

std::string number(double value, int decimals) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
  return text.data();
}

std::string cell(const TableReporter::Column& column,
                 const std::vector<benchmark::BenchmarkReporter::Run>& runs) {
  if (column.counter.empty()) return runs.front().report_label;
  std::vector<double> values;
  for (const auto& run : runs) {
    const auto found = run.counters.find(column.counter);
    if (found != run.counters.end()) values.push_back(found->second.value);
  }
  if (values.empty()) return {};
  const std::string median = number(percentile(values, 50.0), column.decimals);
  if (!column.with_range) return median;
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return median + " (" + number(*least, column.decimals) + " - " + number(*most, column.decimals) + ")";
}

}  // namespace

TableReporter::TableReporter(std::string row_heading, std::vector<Column> columns)
    : row_heading_(std::move(row_heading)), columns_(std::move(columns)) {}

bool TableReporter::ReportContext(const Context&) {
  std::printf("%s\n\n| %-*s |", context_line().c_str(), kRowHeadingWidth, row_heading_.c_str());
  for (const Column& column : columns_) std::printf(" %*s |", width(column), column.heading.c_str());
  std::printf("\n|%s|", std::string(kRowHeadingWidth + 2, '-').c_str());
  for (const Column& column : columns_)
    std::printf("%s:|", std::string(static_cast<std::size_t>(width(column)) + 1, '-').c_str());
  std::printf("\n");
  std::fflush(stdout);
  return true;
}

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  if (runs.empty() || runs.front().run_type == Run::RT_Aggregate) return;  // the medians are taken here
  std::printf("| %-*s |", kRowHeadingWidth, runs.front().run_name.function_name.c_str());
  const auto failed = std::ranges::find(runs, true, &Run::error_occurred);
  if (failed != runs.end()) {
    std::printf(" failed: %s |", failed->error_message.c_str());
  } else {
    for (const Column& column : columns_) std::printf(" %*s |", width(column), cell(column, runs).c_str());
  }
  std::printf("\n");
  std::fflush(stdout);
}

void TableReporter::Finalize() {
  std::printf("\nafter the run: %s\n", context_line().c_str());
}

}  // namespace pago::perf
