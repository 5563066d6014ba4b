// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>
#include <vector>

#include "pago/evaluation/ground_report.hpp"

namespace pago::evaluation {

/// One per method. Throws Error for a comparison that is not one.
std::vector<GroundSummary> summaries(const GroundComparison& comparison);

/// What a protocol does with vegetation, in words.
std::string_view rule_of(GroundProtocol protocol) noexcept;

}  // namespace pago::evaluation
