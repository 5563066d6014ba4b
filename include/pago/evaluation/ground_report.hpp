// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
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

/// A table for the terminal: per method precision, recall and F1 in percent, as mean and deviation over the
/// frames, and of all points together. Ends with a line feed.
std::string ground_table(const GroundComparison& comparison);

/// A row per method and frame, below a line of names: method, frame, the counts, the scores in [0, 1].
std::string ground_csv(const GroundComparison& comparison);

/// A page that needs nothing but itself: for each comparison the table, and precision and recall over the
/// frames, a line per method. `title` is plain text.
std::string ground_page(const std::string& title, std::span<const GroundComparison> comparisons);

}  // namespace pago::evaluation
