// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace pago::test {

/// Called for each heap call, from inside it: they must not call the heap themselves.
void on_allocate() noexcept;
void on_free() noexcept;

}  // namespace pago::test
