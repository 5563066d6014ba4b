// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Against SemanticKITTI's labels of one real scan (a slope), by both protocols. The figures of the authors'
// own codes on this scan are the yardstick.
#include <cstdio>

#include "pago/evaluation/ground_metrics.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "tests/ground/cases.hpp"

using namespace pago;
using namespace pago::test;
using evaluation::GroundProtocol;
using evaluation::GroundScore;

namespace {

constexpr Mount kKitti{.height_m = 1.723};

struct Scores {
  GroundScore a, b;
};

Scores judge(const char* name, const GroundConfig& config, const std::filesystem::path& folder) {
  Sweep sweep(kMaxReturns);
  KittiSource source(folder);
  REQUIRE(source.fill(sweep));
  const auto labels = evaluation::read_semantic_labels(folder / "labels" / "000000.label", sweep.size);
  segment(*ground::make_segmenter(config, kKitti, sweep.capacity()), sweep);
  const auto score = [&](GroundProtocol protocol) {
    return ground_score(
        count_ground(protocol, labels, sweep.z_m.first(sweep.size), sweep.ground.first(sweep.size)));
  };
  const Scores scores{score(GroundProtocol::kPatchwork), score(GroundProtocol::kPatchworkPlusPlus)};
  const auto print = [&](const char* protocol, const GroundScore& s) {
    std::printf("%-22s %s  precision %5.2f  recall %5.2f  F1 %5.2f %%\n", name, protocol, 100.0 * s.precision,
                100.0 * s.recall, 100.0 * s.f1);
  };
  print("A", scores.a);
  print("B", scores.b);
  return scores;
}

void check_percent(const GroundScore& s, double precision, double recall, double f1, double margin) {
  CHECK(100.0 * s.precision == Approx(precision).margin(margin));
  CHECK(100.0 * s.recall == Approx(recall).margin(margin));
  CHECK(100.0 * s.f1 == Approx(f1).margin(margin));
}

}  // namespace

TEST_CASE("Patchwork on labels: F1 of at least 97 %", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  GroundConfig config;
  config.method = "patchwork";
  CHECK(judge("patchwork", config, folder).b.f1 >= 0.970);
}

TEST_CASE("Patchwork with the paper's low cut repeats the figures of its authors' code",
          "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  GroundConfig config;
  config.method = "patchwork";
  config.patchwork.low_cut_below_ground_m = 0.8 * kKitti.height_m;
  const Scores scores = judge("patchwork (paper cut)", config, folder);
  check_percent(scores.a, 97.3, 91.9, 94.5, 0.2);
  check_percent(scores.b, 98.8, 96.0, 97.4, 0.2);
}

TEST_CASE("the uniform column test repeats the figures of LeGO-LOAM's code exactly", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  GroundConfig config;
  config.method = "lego";
  config.lego.projection = LegoConfig::Projection::kUniform;
  const Scores scores = judge("lego (uniform)", config, folder);
  check_percent(scores.a, 96.2, 76.4, 85.2, 0.0501);
  check_percent(scores.b, 98.9, 78.5, 87.5, 0.0501);
}

TEST_CASE("the column test between neighbouring lasers beats the uniform grid", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  GroundConfig config;
  config.method = "lego";
  const Scores scores = judge("lego (ring)", config, folder);
  CHECK(scores.a.f1 > 0.920);
  CHECK(scores.b.f1 > 0.950);
}
