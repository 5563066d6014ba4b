// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string_view>

namespace pago::page {

/// The style sheet and the script of every page.
std::string_view style() noexcept;
std::string_view script() noexcept;

}  // namespace pago::page
