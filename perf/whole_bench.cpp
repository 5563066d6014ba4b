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

/// What the pipeline's three threads do, on one.
struct WholeWay {
  explicit WholeWay(const Drive& drive)
      : feed(drive),
        segmenter(ground::make_segmenter(drive.config.ground, drive.config.mount, max_returns(drive.config))),
        extractor(drive.config.features, max_returns(drive.config)),
        mapper(drive.config.mapping),
        odometer(drive.config.odometry, max_returns(drive.config), mapper.refined()) {}

  void run() noexcept {
    Sweep* sweep = feed.next();
    if (sweep == nullptr) return;
    process(*segmenter, *sweep);
    process(extractor, *sweep);
    process(odometer, *sweep);
    process(mapper, *sweep);
    odometer.update(*sweep);
    mapper.update(*sweep);
  }

  SweepFeed feed;
  std::unique_ptr<ground::Segmenter> segmenter;
  features::FeaturesStage extractor;
  mapping::MappingStage mapper;
  odometry::OdometryStage odometer;
};

void measure_whole(benchmark::State& state, const Drive& drive) {
  StageTimer timer(state, drive);
  std::unique_ptr<WholeWay> way;
  std::size_t packets = 0, sweeps = 0;
  for ([[maybe_unused]] auto _ : state) {
    if (sweeps++ % drive.num_sweeps == 0) way = std::make_unique<WholeWay>(drive);
    const std::size_t used_before = way->feed.packets_used();
    timer.time([&] { way->run(); });
    packets += way->feed.packets_used() - used_before;
  }
  timer.report(packets);
}

}  // namespace

void register_whole(const Drive& drive) {
  register_per_sweep("all: packets to poses", drive,
                     [&drive](benchmark::State& state) { measure_whole(state, drive); });
}

}  // namespace pago::perf
