// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "progress_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace pago::app {

ProgressLine::ProgressLine() : is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressLine::~ProgressLine() {
  clear();
}

void ProgressLine::clear() {
  if (is_shown_) std::fprintf(stderr, "\r\033[K");
  is_shown_ = false;
}

void ProgressLine::count(const output::SweepRecord& record) noexcept {
  ++sweeps_;
  health_ = record.health;
}

void ProgressLine::show(const Progress& progress) {
  const Clock::time_point now = Clock::now();
  if (!is_terminal_ || now < next_) return;
  next_ = now + std::chrono::milliseconds(500);
  is_shown_ = true;
  const double elapsed_s = std::chrono::duration<double>(now - start_).count();
  std::fprintf(stderr, "\r\033[K%llu sweeps, %.1f per second", static_cast<unsigned long long>(sweeps_),
               static_cast<double>(sweeps_) / std::max(elapsed_s, 1e-3));
  if (health_) std::fprintf(stderr, ", %s", std::string(to_string(*health_)).c_str());
  if (progress.total > 0.0 && progress.done > 0.0) {
    const double share = std::min(1.0, progress.done / progress.total);
    std::fprintf(stderr, ", %.0f %%, %.0f s left", 100.0 * share, elapsed_s * (1.0 - share) / share);
  }
  std::fflush(stderr);
}

}  // namespace pago::app
