// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "pago/evaluation/ground_report.hpp"

namespace pago::evaluation {

/// What reports show, in this order.
inline constexpr double GroundScore::*kReported[] = {&GroundScore::precision, &GroundScore::recall,
                                                     &GroundScore::f1};

/// One per method. Throws Error for a comparison that is not one.
std::vector<GroundSummary> summaries(const GroundComparison& comparison);

/// A score in [0, 1], or a spread of scores, in percent, of `width`; "n/a" if it is not defined.
std::string percent(double score, int width = 0);

/// How many frames count, and how many do not.
std::string frames_text(const GroundComparison& comparison, std::span<const GroundSummary> all);

/// What a protocol does with vegetation, in words.
std::string_view rule_of(GroundProtocol protocol) noexcept;

}  // namespace pago::evaluation
