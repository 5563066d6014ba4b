// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "stop_signal.hpp"

#include <csignal>

namespace pago::app {

std::atomic<bool> stop_requested{false};

void stop_on_signals() {
  const auto handler = [](int signal) {
    stop_requested.store(true, std::memory_order_relaxed);
    std::signal(signal, SIG_DFL);
  };
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

}  // namespace pago::app
