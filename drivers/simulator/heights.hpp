// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "streets.hpp"

namespace pago::simulator {

/// Makes the heights of one long street, in the order in which it is driven, smooth (over 12 m to either
/// side), and the same wherever it comes back to a place: the smallest change of its grades in the least
/// squares sense. Sets grades too. [set-up]
void agree_on_heights(std::vector<StreetPoint>& street);

}  // namespace pago::simulator
