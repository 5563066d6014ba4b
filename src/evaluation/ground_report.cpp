// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_report.hpp"

#include <cmath>

#include "pago/core/csv.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {
namespace {

/// What tables and rows show, in this order.
constexpr double GroundScore::*kReported[] = {&GroundScore::precision, &GroundScore::recall,
                                              &GroundScore::f1};

}  // namespace

std::vector<GroundSummary> ground_summaries(const GroundComparison& comparison) {
  std::vector<GroundSummary> result;
  for (const GroundComparison::Row& row : comparison.methods) {
    if (row.counts.size() != comparison.frames.size())
      throw Error("ground report", row.method + " has " + std::to_string(row.counts.size()) + " counts for " +
                                       std::to_string(comparison.frames.size()) + " frames");
    result.push_back(summarize_ground(row.counts));
    if (result.back().protocol != comparison.protocol)
      throw Error("ground report", row.method + " was counted by the other protocol");
  }
  return result;
}

std::string percent_text(double score, int width) {
  return std::isnan(score) ? format("%*s", width, "n/a") : format("%*.2f", width, 100.0 * score);
}

std::string frames_text(const GroundComparison& comparison) {
  const std::vector<GroundSummary> all = ground_summaries(comparison);
  const std::size_t counted = all.empty() ? comparison.frames.size() : all.front().num_frames;
  const std::size_t left_out = comparison.frames.size() - counted;
  return format("%zu frames", counted) +
         (left_out == 0 ? "" : format(", and %zu without ground that are in no mean", left_out));
}

std::string_view vegetation_rule(GroundProtocol protocol) noexcept {
  return protocol == GroundProtocol::kPatchwork ? "low vegetation is ground, other vegetation is not"
                                                : "vegetation is left out";
}

std::string ground_table(const GroundComparison& comparison) {
  const std::vector<GroundSummary> all = ground_summaries(comparison);
  std::string text =
      "protocol " + std::string(to_string(comparison.protocol)) + ": " +
      std::string(vegetation_rule(comparison.protocol)) + "; " + frames_text(comparison) + "; %\n" +
      "                      mean +- deviation over the frames             all points together\n"
      "  method            precision        recall            F1   precision  recall      F1\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const GroundScore &mean = all[i].mean, &deviation = all[i].deviation, &pooled = all[i].pooled;
    text += format("  %-15s", comparison.methods[i].method.c_str());
    for (const auto figure : kReported)
      text += ' ' + percent_text(mean.*figure, 6) + " +- " + percent_text(deviation.*figure, 4);
    text += "  ";
    for (const auto figure : kReported) text += percent_text(pooled.*figure, figure == kReported[0] ? 9 : 8);
    text += '\n';
  }
  return text;
}

std::string ground_csv(const GroundComparison& comparison) {
  ground_summaries(comparison);
  std::string text =
      "method,frame,true_positive,false_positive,false_negative,true_negative,excluded,precision,recall,f1\n";
  for (const GroundComparison::Row& row : comparison.methods) {
    for (std::size_t i = 0; i < comparison.frames.size(); ++i) {
      const GroundCounts& c = row.counts[i];
      const GroundScore score = ground_score(c);
      text += row.method + ',' + std::to_string(comparison.frames[i]);
      for (const std::uint64_t count :
           {c.true_positive, c.false_positive, c.false_negative, c.true_negative, c.excluded})
        text += ',' + std::to_string(count);
      for (const auto figure : kReported)
        text += std::isnan(score.*figure) ? ",n/a" : format(",%.6f", score.*figure);
      text += '\n';
    }
  }
  return text;
}

std::string ground_csv_name(GroundProtocol protocol) {
  return protocol == GroundProtocol::kPatchwork ? "protocol_a.csv" : "protocol_b.csv";
}

GroundComparison read_ground_csv(const std::filesystem::path& file, GroundProtocol protocol) {
  const CsvTable table = CsvTable::read(file);
  const std::size_t method = table.at("method"), frame = table.at("frame"), tp = table.at("true_positive"),
                    fp = table.at("false_positive"), fn = table.at("false_negative"),
                    tn = table.at("true_negative"), excluded = table.at("excluded");
  GroundComparison comparison{.protocol = protocol, .frames = {}, .methods = {}};
  for (std::size_t i = 0; i < table.num_rows(); ++i) {
    auto& methods = comparison.methods;
    if (methods.empty() || methods.back().method != table.text(i, method))
      methods.push_back({table.text(i, method), {}});
    auto& counts = methods.back().counts;
    if (methods.size() == 1) comparison.frames.push_back(table.count(i, frame));
    if (counts.size() >= comparison.frames.size() ||
        comparison.frames[counts.size()] != table.count(i, frame))
      throw Error(file.string() + ":" + std::to_string(i + 2),
                  "the methods were not counted on the same frames");
    counts.push_back({protocol, table.count(i, tp), table.count(i, fp), table.count(i, fn),
                      table.count(i, tn), table.count(i, excluded)});
  }
  ground_summaries(comparison);
  return comparison;
}

std::vector<GroundComparison> read_ground_folder(const std::filesystem::path& folder) {
  std::vector<GroundComparison> comparisons;
  for (const GroundProtocol protocol : {GroundProtocol::kPatchwork, GroundProtocol::kPatchworkPlusPlus}) {
    const std::filesystem::path file = folder / ground_csv_name(protocol);
    if (std::filesystem::exists(file)) comparisons.push_back(read_ground_csv(file, protocol));
  }
  if (comparisons.empty())
    throw Error(folder.string(), "holds no counts of ground masks",
                "pago segment writes them for a drive with labels");
  return comparisons;
}

}  // namespace pago::evaluation
