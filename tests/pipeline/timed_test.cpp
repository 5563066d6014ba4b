// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/timed.hpp"

#include "support/catch.hpp"

using namespace pago;

namespace {

struct Busy {
  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept { work(); }
  void finish(Sweep&) noexcept { work(); }
  void work() noexcept {
    const std::int64_t until_ns = platform::thread_cpu_ns() + 2'000'000;
    while (platform::thread_cpu_ns() < until_ns) {
    }
  }
};

}  // namespace

TEST_CASE("a stage's CPU time is summed over its parts, its wall time spans them", "[pipeline][timed]") {
  Sweep sweep(10);
  Busy busy;
  Timed timed(StageId::kFeatures, busy);
  timed.begin(sweep);
  timed.accept({&sweep, 0, 0, false});
  timed.accept({&sweep, 0, 0, true});
  timed.finish(sweep);
  const StageTime& time = sweep.time_of(StageId::kFeatures);
  REQUIRE(time.cpu_ns >= 6'000'000);
  REQUIRE(time.end_ns - time.start_ns >= time.cpu_ns);
  REQUIRE(sweep.time_of(StageId::kGround).cpu_ns == 0);
}
