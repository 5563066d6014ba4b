// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace pago::app {

/// Set by the first SIGINT or SIGTERM after stop_on_signals().
extern std::atomic<bool> stop_requested;

/// The first signal ends the work and flushes every output; a second one kills, as nothing may hang for ever.
void stop_on_signals();

}  // namespace pago::app
