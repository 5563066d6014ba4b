// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/features/features.hpp"
#include "pago/ground/segmenter.hpp"
#include "stage_rig.hpp"
#include "stages.hpp"

namespace pago::perf {

namespace {

struct ClustersRig {
  explicit ClustersRig(const Config& config)
      : segmenter(ground::make_segmenter(config.ground, config.mount, max_returns(config))),
        clusterer(config.features.clustering, max_returns(config)) {}

  void prepare(Sweep& sweep) noexcept { process(*segmenter, sweep); }
  void run(Sweep& sweep) noexcept { clusterer.label(sweep); }

  std::unique_ptr<ground::Segmenter> segmenter;
  features::Clusterer clusterer;
};

struct FeaturesRig {
  explicit FeaturesRig(const Config& config)
      : segmenter(ground::make_segmenter(config.ground, config.mount, max_returns(config))),
        extractor(config.features, max_returns(config)) {}

  void prepare(Sweep& sweep) noexcept { process(*segmenter, sweep); }
  void run(Sweep& sweep) noexcept { process(extractor, sweep); }

  std::unique_ptr<ground::Segmenter> segmenter;
  features::FeaturesStage extractor;
};

}  // namespace

void register_features(const Drive& drive) {
  register_per_sweep("clusters", drive,
                     [&drive](benchmark::State& state) { measure<ClustersRig>(state, drive); });
  register_per_sweep("clusters and features", drive,
                     [&drive](benchmark::State& state) { measure<FeaturesRig>(state, drive); });
}

}  // namespace pago::perf
