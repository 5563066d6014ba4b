// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

namespace pago::evaluation {

/// A figure that there is nothing to make of.
inline constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

}  // namespace pago::evaluation
