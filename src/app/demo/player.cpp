// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "player.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>

#include "pago/core/error.hpp"

namespace pago::app {

Player::Player(const std::filesystem::path& capture, int port) {
  const std::string to = "127.0.0.1:" + std::to_string(port), file = capture.string();
  std::array<const char*, 6> words{"pago", "play", file.c_str(), "--to", to.c_str(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  // Its summary is not the demo's.
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawn(&child_, "/proc/self/exe", &actions, nullptr,
                                const_cast<char* const*>(words.data()), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) throw Error("pago play", std::string("cannot be started: ") + std::strerror(error));
}

Player::~Player() {
  if (has_ended()) return;
  kill(child_, SIGKILL);
  waitpid(child_, nullptr, 0);
}

bool Player::has_ended() {
  if (child_ < 0) return true;
  int status = 0;
  if (waitpid(child_, &status, WNOHANG) != child_) return false;
  exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  child_ = -1;
  return true;
}

}  // namespace pago::app
