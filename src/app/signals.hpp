// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>

namespace pago::app {

/// From now on the first SIGINT or SIGTERM asks for an end in good order; a second one kills, as nothing may
/// hang for ever.
void stop_on_signals();

const std::atomic<bool>& stop_flag() noexcept;
inline bool stop_requested() noexcept {
  return stop_flag().load(std::memory_order_relaxed);  // acted on soon, not at once
}

}  // namespace pago::app
