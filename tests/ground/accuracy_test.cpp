// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Against SemanticKITTI's labels of one real scan (a slope), by both protocols. The figures of the authors'
// own codes on this scan are the yardstick.
#include <cstdio>
#include <string>
#include <vector>

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

Scores judge(const std::string& name, const GroundConfig& config, const std::filesystem::path& folder) {
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
    std::printf("%-22s %s  precision %5.2f  recall %5.2f  F1 %5.2f %%\n", name.c_str(), protocol,
                100.0 * s.precision, 100.0 * s.recall, 100.0 * s.f1);
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

GroundConfig method(const char* name) {
  GroundConfig config;
  config.method = name;
  return config;
}

GroundConfig patchwork_with_papers_cut() {
  GroundConfig config = method("patchwork");
  config.patchwork.low_cut_below_ground_m = 0.8 * kKitti.height_m;
  return config;
}

GroundConfig uniform_lego() {
  GroundConfig config = method("lego");
  config.lego.projection = LegoConfig::Projection::kUniform;
  return config;
}

GroundConfig gpf_in_slabs() {
  GroundConfig config = method("gpf");
  config.gpf.planes = GpfConfig::Planes::kSlabs;
  return config;
}

GroundConfig ransac_as_pcl() {
  GroundConfig config = method("ransac");
  config.ransac.max_iterations = 50;
  config.ransac.max_tilt_deg = 90.0;
  return config;
}

}  // namespace

TEST_CASE("with the same parameters, no method is more than 1 % of F1 below its authors' code",
          "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  struct Row {
    std::string name;
    GroundConfig config;
    double authors_b, authors_a;  // F1 in %; 0: not known
  };
  const std::vector<Row> rows{
      {"patchwork (paper cut)", patchwork_with_papers_cut(), 97.4, 94.5},
      {"patchworkpp", method("patchworkpp"), 98.4, 95.8},
      {"lego (uniform)", uniform_lego(), 87.5, 85.2},
      {"rgpf", method("rgpf"), 94.9, 0.0},
      {"ransac (as PCL)", ransac_as_pcl(), 97.8, 0.0},
      {"cascaded", method("cascaded"), 90.0, 0.0},
      {"linefit", method("linefit"), 79.7, 0.0},
      {"gpf", method("gpf"), 32.5, 0.0},
      {"gpf (slabs)", gpf_in_slabs(), 61.3, 0.0},
  };
  for (const Row& row : rows) {
    INFO(row.name);
    const Scores scores = judge(row.name, row.config, folder);
    CHECK(100.0 * scores.b.f1 >= row.authors_b - 1.0);
    CHECK(100.0 * scores.a.f1 >= row.authors_a - 1.0);
  }
}

TEST_CASE("where nothing was changed, the figures of the authors' codes come out again",
          "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  const Scores patchwork = judge("patchwork (paper cut)", patchwork_with_papers_cut(), folder);
  check_percent(patchwork.a, 97.3, 91.9, 94.5, 0.2);
  check_percent(patchwork.b, 98.8, 96.0, 97.4, 0.2);
  const Scores plus = judge("patchworkpp", method("patchworkpp"), folder);
  check_percent(plus.a, 98.2, 93.5, 95.8, 0.1);
  check_percent(plus.b, 99.1, 97.8, 98.4, 0.1);
  const Scores lego = judge("lego (uniform)", uniform_lego(), folder);
  check_percent(lego.a, 96.2, 76.4, 85.2, 0.0501);
  check_percent(lego.b, 98.9, 78.5, 87.5, 0.0501);
  check_percent(judge("rgpf", method("rgpf"), folder).b, 96.9, 93.1, 94.9, 0.1);
  check_percent(judge("gpf", method("gpf"), folder).b, 96.8, 19.5, 32.5, 0.0501);
}

TEST_CASE("Patchwork with PaGO's low cut: F1 of at least 98 %", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  CHECK(judge("patchwork", method("patchwork"), folder).b.f1 >= 0.980);
}

TEST_CASE("the column test between neighbouring lasers beats the uniform grid", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  const Scores scores = judge("lego (ring)", method("lego"), folder);
  CHECK(scores.a.f1 > 0.920);
  CHECK(scores.b.f1 > 0.950);
}

TEST_CASE("the truth scores 100 % by the protocol that it follows", "[ground][accuracy]") {
  PAGO_DATA_OR_SKIP(folder, "kitti/semantickitti_single");
  CHECK(judge("truth", method("truth"), folder).b.f1 == 1.0);
  GroundConfig config = method("truth");
  config.truth.low_vegetation = true;
  CHECK(judge("truth (low vegetation)", config, folder).a.f1 > 0.9995);  // 1.723 m is not 1.73 m
}
