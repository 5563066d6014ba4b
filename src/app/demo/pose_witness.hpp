// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <sys/types.h>

#include <string>

#include "pago/core/histogram.hpp"

namespace pago::app {

/// When another process really holds a pose: a child that sleeps on the shared memory where poses are
/// published and looks at the clock when it has copied one.
class PoseWitness {
 public:
  /// [set-up] Before the process has other threads, after the board of that name exists. Throws Error if
  /// there can be no child.
  explicit PoseWitness(const std::string& board);
  ~PoseWitness();
  PoseWitness(const PoseWitness&) = delete;
  PoseWitness& operator=(const PoseWitness&) = delete;

  /// Ends the child. What it saw is final afterwards.
  void stop();

  /// From the arrival of a sweep's last packet until the witness held its first, and its refined pose.
  const LatencyHistogram& first() const noexcept { return seen_->first; }
  const LatencyHistogram& refined() const noexcept { return seen_->refined; }

 private:
  struct Seen {
    LatencyHistogram first, refined;
  };
  [[noreturn]] static void watch(const std::string& board, Seen& seen);

  Seen* seen_;  // shared with the child
  pid_t child_ = -1;
};

}  // namespace pago::app
