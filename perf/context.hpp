// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pago::perf {

/// What a measurement belongs to, in one line: machine, kernel, commit, date, and how busy the machine is
/// just now. A figure without it means nothing.
std::string context_line();

}  // namespace pago::perf
