// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace pago::test {

/// How often this thread has called operator new so far (under a sanitizer: malloc too). Needs
/// support/new_counter.cpp in the test program.
std::uint64_t news_so_far() noexcept;

}  // namespace pago::test
