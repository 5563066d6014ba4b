// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_report.hpp"

#include <cmath>

#include "ground_summaries.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {

std::vector<GroundSummary> summaries(const GroundComparison& comparison) {
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

std::string percent(double score, int width) {
  return std::isnan(score) ? format("%*s", width, "n/a") : format("%*.2f", width, 100.0 * score);
}

std::string frames_text(const GroundComparison& comparison, std::span<const GroundSummary> all) {
  const std::size_t counted = all.empty() ? comparison.frames.size() : all.front().num_frames;
  const std::size_t left_out = comparison.frames.size() - counted;
  return format("%zu frames", counted) +
         (left_out == 0 ? "" : format(", and %zu without ground that are in no mean", left_out));
}

std::string_view rule_of(GroundProtocol protocol) noexcept {
  return protocol == GroundProtocol::kPatchwork ? "low vegetation is ground, other vegetation is not"
                                                : "vegetation is left out";
}

std::string ground_table(const GroundComparison& comparison) {
  const std::vector<GroundSummary> all = summaries(comparison);
  std::string text =
      "protocol " + std::string(to_string(comparison.protocol)) + ": " +
      std::string(rule_of(comparison.protocol)) + "; " + frames_text(comparison, all) + "; %\n" +
      "                      mean +- deviation over the frames             all points together\n"
      "  method            precision        recall            F1   precision  recall      F1\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const GroundScore &mean = all[i].mean, &deviation = all[i].deviation, &pooled = all[i].pooled;
    text += format("  %-15s", comparison.methods[i].method.c_str());
    for (const auto figure : kReported)
      text += ' ' + percent(mean.*figure, 6) + " +- " + percent(deviation.*figure, 4);
    text += "  ";
    for (const auto figure : kReported) text += percent(pooled.*figure, figure == kReported[0] ? 9 : 8);
    text += '\n';
  }
  return text;
}

std::string ground_csv(const GroundComparison& comparison) {
  summaries(comparison);
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

}  // namespace pago::evaluation
