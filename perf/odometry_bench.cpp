// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/features.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/odometry/odometry.hpp"
#include "stage_rig.hpp"
#include "stages.hpp"

namespace pago::perf {

namespace {

struct OdometryRig {
  explicit OdometryRig(const Config& config)
      : segmenter(ground::make_segmenter(config.ground, config.mount, max_returns(config))),
        extractor(config.features, max_returns(config)),
        odometer(config.odometry, max_returns(config)) {}

  void prepare(Sweep& sweep) noexcept {
    process(*segmenter, sweep);
    process(extractor, sweep);
  }
  void run(Sweep& sweep) noexcept { process(odometer, sweep); }

  std::unique_ptr<ground::Segmenter> segmenter;
  features::FeaturesStage extractor;
  odometry::OdometryStage odometer;
};

}  // namespace

void register_odometry(const Drive& drive) {
  register_per_sweep("odometry", drive,
                     [&drive](benchmark::State& state) { measure<OdometryRig>(state, drive); });
}

}  // namespace pago::perf
