// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "pago/core/sources.hpp"
#include "pago/output/sweep_record.hpp"

namespace pago::app {

/// One line on the terminal that says how far a run has come, written anew twice a second and wiped at the
/// end. Silent when standard error is no terminal.
class ProgressLine {
 public:
  ProgressLine();
  ~ProgressLine();

  void count(const output::SweepRecord& record) noexcept;
  /// So many sweeps are done, of which there is nothing more to say.
  void count_to(std::uint64_t sweeps) noexcept { sweeps_ = sweeps; }
  void show(const Progress& progress);
  /// Makes room for another message; the line comes again.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool is_terminal_;
  Clock::time_point start_ = Clock::now(), next_ = start_;
  std::uint64_t sweeps_ = 0;
  std::optional<Health> health_;  // of the last sweep that has one
  bool is_shown_ = false;
};

}  // namespace pago::app
