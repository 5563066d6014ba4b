// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <memory>

#include "stage_timer.hpp"
#include "stages.hpp"
#include "sweep_feed.hpp"

namespace pago::perf {

namespace {

void measure_ingest(benchmark::State& state, const Drive& drive) {
  StageTimer timer(state, drive);
  std::unique_ptr<SweepFeed> feed;
  std::size_t packets = 0, sweeps = 0;
  for ([[maybe_unused]] auto _ : state) {
    if (sweeps++ % drive.num_sweeps == 0) feed = std::make_unique<SweepFeed>(drive);
    const std::size_t used_before = feed->packets_used();
    timer.time([&] { benchmark::DoNotOptimize(feed->next()); });
    packets += feed->packets_used() - used_before;
  }
  timer.report(packets);
}

}  // namespace

void register_ingest(const Drive& drive) {
  register_per_sweep("ingest: packets to sweeps", drive,
                     [&drive](benchmark::State& state) { measure_ingest(state, drive); });
}

}  // namespace pago::perf
