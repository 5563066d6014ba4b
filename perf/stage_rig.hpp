// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/core/stage.hpp"
#include "stage_timer.hpp"
#include "sweep_feed.hpp"

namespace pago::perf {

inline std::uint32_t max_returns(const Config& config) {
  return max_returns_of(config.assembly, /*can_be_dual=*/true);
}

/// Drives the sweeps through a rig again and again: `prepare(sweep)` is what comes before the stage, and
/// `settle(sweep)`, where there is one, after it; they are not timed. `run(sweep)` is the stage. All begin
/// anew with the drive.
template <typename Rig, typename MakeRig>
void measure(benchmark::State& state, const Drive& drive, MakeRig make_rig) {
  StageTimer timer(state, drive);
  std::unique_ptr<SweepFeed> feed;
  std::unique_ptr<Rig> rig;
  for ([[maybe_unused]] auto _ : state) {
    Sweep* sweep = feed ? feed->next() : nullptr;
    if (sweep == nullptr) {
      feed = std::make_unique<SweepFeed>(drive);
      rig = make_rig();
      sweep = feed->next();
    }
    rig->prepare(*sweep);
    timer.time([&] { rig->run(*sweep); });
    if constexpr (requires { rig->settle(*sweep); }) rig->settle(*sweep);
  }
  timer.report();
}

template <typename Rig>
void measure(benchmark::State& state, const Drive& drive) {
  measure<Rig>(state, drive, [&] { return std::make_unique<Rig>(drive.config); });
}

}  // namespace pago::perf
