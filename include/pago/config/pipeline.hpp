// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [pipeline.<thread>] Where a thread runs and how urgently.
struct ThreadConfig {
  int cpu = -1;
  int fifo_priority = 0;
};

template <typename Visitor>
void describe(Visitor& v, ThreadConfig& c) {
  v("cpu", c.cpu, within(-1, 1023), "core that the thread is kept on; -1: any");
  v("fifo_priority", c.fifo_priority, within(0, 98),
    "SCHED_FIFO priority while a live sensor is read; 0: normal. Replays always run at normal priority");
}

/// [pipeline]
struct PipelineConfig {
  ThreadConfig ingest{0, 80};
  ThreadConfig front{0, 70};
  ThreadConfig estimate{1, 70};
  int max_pending = 2;
};

template <typename Visitor>
void describe(Visitor& v, PipelineConfig& c) {
  v.section("ingest", c.ingest, "receives, decodes and assembles");
  v.section("front", c.front, "ground, clusters and features");
  v.section("estimate", c.estimate, "odometry and mapping");
  v("max_pending", c.max_pending, within(1, 64),
    "while a live sensor is read: when more complete sweeps than this wait for a thread, it skips to the "
    "newest");
}

}  // namespace pago
