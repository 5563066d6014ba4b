// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <cstdio>

#include "drive.hpp"
#include "pago/core/error.hpp"
#include "stages.hpp"
#include "table.hpp"

using namespace pago;

namespace {

void run_table(const perf::Drive& drive) {
  perf::register_decode(drive);
  perf::register_ingest(drive);
  perf::register_ground(drive);
  perf::register_features(drive);
  perf::register_odometry(drive);
  perf::register_whole(drive);
  std::printf("drive_0005: %zu packets, %zu sweeps, %.2f MB each\n", drive.datagrams.size(), drive.num_sweeps,
              static_cast<double>(drive.sweep_bytes) * 1e-6);
  perf::TableReporter table("stage, thread CPU per sweep", {{"p50 ms", "p50_ms", 2, true},
                                                            {"p99 ms", "p99_ms", 2},
                                                            {"copy ms", "copy_ms", 3, true},
                                                            {"p50/copy", "per_copy", 1},
                                                            {"packets/s", "packets_s", 0}});
  benchmark::RunSpecifiedBenchmarks(&table);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  try {
    const auto drive = perf::load_drive();
    if (!drive) {
      std::printf("skipped, nothing was measured: needs packets/drive_0005/drive_0005.pcap in $PAGO_DATA\n");
      return 0;
    }
    run_table(*drive);
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
