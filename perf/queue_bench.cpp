// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include "queues.hpp"
#include "table.hpp"

using namespace pago;

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  perf::register_throughput();
  perf::register_hand_over();
  perf::TableReporter table("queue", {{"scheduling", ""},
                                      {"ns/element", "element_ns", 1, true},
                                      {"million/s", "million_s", 1},
                                      {"wake p50 us", "p50_us", 1, true},
                                      {"p90 us", "p90_us", 1},
                                      {"p99 us", "p99_us", 1},
                                      {"push us", "push_us", 1}});
  benchmark::RunSpecifiedBenchmarks(&table);
}
