// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "pago/ground/segmenter.hpp"
#include "stage_rig.hpp"
#include "stages.hpp"

namespace pago::perf {

namespace {

struct GroundRig {
  std::unique_ptr<ground::Segmenter> segmenter;

  void prepare(Sweep&) noexcept {}
  void run(Sweep& sweep) noexcept { process(*segmenter, sweep); }
};

void measure_method(benchmark::State& state, const Drive& drive, const ground::Method& method) {
  const Config& config = drive.config;
  measure<GroundRig>(state, drive, [&] {
    return std::make_unique<GroundRig>(
        GroundRig{method.make(config.ground, config.mount, max_returns(config))});
  });
}

}  // namespace

void register_ground(const Drive& drive) {
  for (const ground::Method& method : ground::methods()) {
    register_per_sweep(("ground: " + std::string(method.name)).c_str(), drive,
                       [&](benchmark::State& state) { measure_method(state, drive, method); });
  }
}

}  // namespace pago::perf
