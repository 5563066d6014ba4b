// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace pago::app {

/// A sensor in a process of its own: `pago play`, which sends a capture's packets when they were sent.
class Player {
 public:
  /// [set-up] Starts it. Throws Error if it cannot be.
  Player(const std::filesystem::path& capture, int port);
  ~Player();
  Player(const Player&) = delete;
  Player& operator=(const Player&) = delete;

  /// True once it has sent everything, or died.
  bool has_ended();
  /// Its exit code once it has ended.
  int exit_code() const noexcept { return exit_code_; }

 private:
  pid_t child_ = -1;
  int exit_code_ = -1;
};

}  // namespace pago::app
