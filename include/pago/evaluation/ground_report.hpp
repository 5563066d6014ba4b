// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pago/evaluation/ground_metrics.hpp"

namespace pago::evaluation {

/// Several methods' counts on the same frames, all by one protocol: a report never shows two side by side.
struct GroundComparison {
  GroundProtocol protocol = GroundProtocol::kPatchwork;
  std::vector<std::uint64_t> frames;  ///< their numbers, ascending
  struct Row {
    std::string method;
    std::vector<GroundCounts> counts;  ///< one per frame
  };
  std::vector<Row> methods;
};

// [set-up] All of them throw Error where a method has not one count for each frame, or of another protocol.

/// One per method.
std::vector<GroundSummary> ground_summaries(const GroundComparison& comparison);

/// What a protocol does with vegetation, in words.
std::string_view vegetation_rule(GroundProtocol protocol) noexcept;

/// A score in [0, 1], or a spread of scores, in percent, of `width`; "n/a" if it is not defined.
std::string percent_text(double score, int width = 0);

/// How many frames count, and how many do not.
std::string frames_text(const GroundComparison& comparison);

/// A table for the terminal: per method precision, recall and F1 in percent, as mean and deviation over the
/// frames, and of all points together. Ends with a line feed.
std::string ground_table(const GroundComparison& comparison);

/// A row per method and frame, below a line of names: method, frame, the counts, the scores in [0, 1].
std::string ground_csv(const GroundComparison& comparison);
/// The name of the file that `pago segment` gives it: protocol_a.csv, protocol_b.csv.
std::string ground_csv_name(GroundProtocol protocol);
/// The counts of such a file; the scores follow from them.
GroundComparison read_ground_csv(const std::filesystem::path& file, GroundProtocol protocol);
/// Those that a folder of `pago segment` has. Error when it has none: its drive had no labels.
std::vector<GroundComparison> read_ground_folder(const std::filesystem::path& folder);

}  // namespace pago::evaluation
