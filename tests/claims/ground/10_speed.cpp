// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Thread CPU time of each method on the drive's sweeps, one core, and the same divided by the time of a loop
// that reads the coordinates and writes the mask, in turns with it. The bounds are on the median.
#include <algorithm>
#include <cmath>
#include <vector>

#include "pago/ground/segmenter.hpp"
#include "pago/platform/clock.hpp"
#include "perf/percentile.hpp"
#include "tests/claims/report.hpp"
#include "tests/support/recorded_sweeps.hpp"

using namespace pago;
using claims::Report;
using perf::percentile;

namespace {

struct Bound {
  const char* method;
  double median_ms;
};
constexpr Bound kBounds[] = {
    {"patchwork", 3.0}, {"patchwork-hdl64", 3.0}, {"lego", 1.5},     {"linefit", 3.0}, {"gpf", 5.0},
    {"rgpf", 5.0},      {"ransac", 8.0},          {"cascaded", 15.0}};
constexpr double kGoal_ms = 2.0;  // for Patchwork

template <typename Work>
double cpu_ms(Work work) {
  const std::int64_t before_ns = platform::thread_cpu_ns();
  work();
  return static_cast<double>(platform::thread_cpu_ns() - before_ns) * 1e-6;
}

/// The least that a method could do: look at every return and write its byte.
void touch(Sweep& sweep) noexcept {
  const float *x = sweep.x_m.data(), *y = sweep.y_m.data(), *z = sweep.z_m.data();
  std::uint8_t* const mask = sweep.ground.data();
  for (std::uint32_t i = 0; i < sweep.size; ++i) mask[i] = x[i] + y[i] + z[i] < 0.0F ? kGround : kNonGround;
}

struct Times {
  std::unique_ptr<ground::Segmenter> segmenter;
  std::vector<double> method_ms, touch_ms;

  void measure(Sweep& sweep) {
    method_ms.push_back(cpu_ms([&] {
      segmenter->begin(sweep);
      segmenter->accept({&sweep, sweep.size, sweep.header.num_columns, true});
      segmenter->finish(sweep);
    }));
    double best_ms = INFINITY;
    for (int i = 0; i < 3; ++i) best_ms = std::min(best_ms, cpu_ms([&] { touch(sweep); }));
    touch_ms.push_back(best_ms);
  }
};

void report(Report& out, const std::string& method, const Times& times) {
  const double median_ms = percentile(times.method_ms, 50.0);
  const std::string name = "ground speed: " + method;
  const auto bound = std::ranges::find_if(kBounds, [&](const Bound& b) { return method == b.method; });
  if (bound != std::end(kBounds))
    out.at_most(name + ", median", median_ms, bound->median_ms, " ms");
  else
    out.shown(name + ", median", format("%.4f ms", median_ms));
  if (method == "patchwork")
    out.shown(name + ", goal", format("%s %.1f ms", median_ms <= kGoal_ms ? "within" : "above", kGoal_ms));
  out.shown(name + ", p99", format("%.4f ms", percentile(times.method_ms, 99.0)));
  out.shown(name + ", against reading and writing the same memory",
            format("%.1f times", median_ms / percentile(times.touch_ms, 50.0)));
}

void measure(Report& out) {
  const auto folder = claims::recording("packets/drive_0005");
  std::vector<Times> all;
  for (const ground::Method& method : ground::methods())
    all.push_back({method.make(GroundConfig{}, Mount{}, 300'000), {}, {}});
  double returns = 0.0, sweeps = 0.0;
  constexpr int kPasses = 2;
  for (int pass = 0; pass < kPasses; ++pass) {
    test::RecordedSweeps drive(folder / "drive_0005.pcap", folder / "calibration.yaml");
    while (Sweep* sweep = drive.next()) {
      for (Times& times : all) times.measure(*sweep);
      returns += sweep->size;
      sweeps += 1.0;
    }
  }
  out.shown("ground speed: sweeps measured", format("%.0f of %.0f returns", sweeps, returns / sweeps));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ground::Method& method = ground::methods()[i];
    if (!method.traits.needs_labels) report(out, std::string(method.name), all[i]);
  }
}

}  // namespace

int main() {
  return claims::run("ground speed", measure);
}
