// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "signals.hpp"

#include <csignal>

namespace pago::app {

namespace {

std::atomic<bool> flag{false};
static_assert(std::atomic<bool>::is_always_lock_free, "set by a signal handler");

}  // namespace

void stop_on_signals() {
  const auto handler = [](int signal) {
    flag.store(true, std::memory_order_relaxed);
    std::signal(signal, SIG_DFL);
  };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, handler);
  // Whoever read the messages or poses may have gone, and files may have a limit: that is found where they
  // are written.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
}

const std::atomic<bool>& stop_flag() noexcept {
  return flag;
}

}  // namespace pago::app
