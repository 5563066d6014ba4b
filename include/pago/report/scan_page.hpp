// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "pago/evaluation/scan_statistics.hpp"

namespace pago::report {

/// What `pago compare --html` writes: drives laid over each other, told apart by colour in their order. At
/// least one drive. `made_by`: program, version and command.
std::string scan_page(const std::vector<evaluation::ScannedDrive>& drives, const std::string& made_by);

}  // namespace pago::report
