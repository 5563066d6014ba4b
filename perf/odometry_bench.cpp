// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/features.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/mapping/mapping.hpp"
#include "pago/odometry/odometry.hpp"
#include "stage_rig.hpp"
#include "stages.hpp"

namespace pago::perf {

namespace {

struct Stages {
  explicit Stages(const Config& config)
      : segmenter(ground::make_segmenter(config.ground, config.mount, max_returns(config))),
        extractor(config.features, max_returns(config)),
        mapper(config.mapping),
        odometer(config.odometry, max_returns(config), mapper.refined()) {}

  void front(Sweep& sweep) noexcept {
    process(*segmenter, sweep);
    process(extractor, sweep);
  }
  void update(Sweep& sweep) noexcept {
    odometer.update(sweep);
    mapper.update(sweep);
  }

  std::unique_ptr<ground::Segmenter> segmenter;
  features::FeaturesStage extractor;
  mapping::MappingStage mapper;
  odometry::OdometryStage odometer;
};

struct OdometryRig : Stages {
  using Stages::Stages;
  void prepare(Sweep& sweep) noexcept { front(sweep); }
  void run(Sweep& sweep) noexcept { process(odometer, sweep); }
  void settle(Sweep& sweep) noexcept {
    process(mapper, sweep);
    update(sweep);
  }
};

struct MappingRig : Stages {
  using Stages::Stages;
  void prepare(Sweep& sweep) noexcept {
    front(sweep);
    process(odometer, sweep);
  }
  void run(Sweep& sweep) noexcept { process(mapper, sweep); }
  void settle(Sweep& sweep) noexcept { update(sweep); }
};

struct UpdateRig : Stages {
  using Stages::Stages;
  void prepare(Sweep& sweep) noexcept {
    front(sweep);
    process(odometer, sweep);
    process(mapper, sweep);
  }
  void run(Sweep& sweep) noexcept { update(sweep); }
};

}  // namespace

void register_odometry(const Drive& drive) {
  register_per_sweep("odometry", drive,
                     [&drive](benchmark::State& state) { measure<OdometryRig>(state, drive); });
  register_per_sweep("mapping", drive,
                     [&drive](benchmark::State& state) { measure<MappingRig>(state, drive); });
  register_per_sweep("update: next targets, local map", drive,
                     [&drive](benchmark::State& state) { measure<UpdateRig>(state, drive); });
}

}  // namespace pago::perf
