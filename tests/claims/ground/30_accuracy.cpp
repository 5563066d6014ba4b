// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The tables of docs/ground.md: every method against labels, by both protocols, on the labelled real scan (a
// slope), on streets of the simulator, and on a test scene, a slope with a rough verge. On the real scan no
// method may be more than 1 % of F1 below what the authors' codes give there with the same settings; on the
// others the default method must reach 95 %. Then what accounts for differences from the authors' codes, and
// what mirror images under the ground do.
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "pago/core/semantic_kitti.hpp"
#include "pago/evaluation/ground_report.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/pipeline/sweep_reader.hpp"
#include "pago/simulator/simulator_source.hpp"
#include "tests/claims/report.hpp"
#include "tests/ground/cases.hpp"
#include "tests/ground/reference/reference.hpp"
#include "tests/support/scene.hpp"

using namespace pago;
using claims::Report;
using evaluation::GroundComparison;
using evaluation::GroundProtocol;
using evaluation::GroundScore;

namespace {

/// F1 of the authors' codes on the real scan, in percent; 0: not known.
struct Yardstick {
  double a = 0.0, b = 0.0;
};
struct Row {
  std::string name;
  Yardstick authors;
  GroundConfig config;
};

Row row(const std::string& method,
        const std::string& variant,
        const Yardstick& authors,
        const std::function<void(GroundConfig&)>& change = {}) {
  Row result{variant.empty() ? method : method + " " + variant, authors, {}};
  result.config.method = method;
  if (change) change(result.config);
  return result;
}

std::vector<Row> rows() {
  constexpr double kKittiHeight_m = 1.723;
  return {
      row("patchwork", "", {94.5, 97.4}),
      row("patchwork", "paper's cut", {94.5, 97.4},
          [](GroundConfig& c) { c.patchwork.low_cut_below_ground_m = 0.8 * kKittiHeight_m; }),
      row("patchwork-hdl64", "", {}),
      row("patchworkpp", "", {95.8, 98.4}),
      row("lego", "", {}),
      row("lego", "uniform", {85.2, 87.5},
          [](GroundConfig& c) { c.lego.projection = LegoConfig::Projection::kUniform; }),
      row("rgpf", "", {0.0, 94.9}),
      row("ransac", "", {}),
      row("ransac", "as PCL", {0.0, 97.8},
          [](GroundConfig& c) { c.ransac.max_iterations = 50, c.ransac.max_tilt_deg = 90.0; }),
      row("cascaded", "", {0.0, 90.0}),
      row("linefit", "", {0.0, 79.7}),
      row("gpf", "", {0.0, 32.5}),
      row("gpf", "slabs", {0.0, 61.3}, [](GroundConfig& c) { c.gpf.planes = GpfConfig::Planes::kSlabs; }),
  };
}

/// All methods at work on one kind of ground.
class Contest {
 public:
  explicit Contest(const Mount& mount) {
    for (std::size_t i = 0; i < both_.size(); ++i) both_[i].protocol = kProtocols[i];
    for (const Row& r : rows()) {
      segmenters_.push_back(ground::make_segmenter(r.config, mount, KittiSource::kMaxPoints));
      for (GroundComparison& comparison : both_) comparison.methods.push_back({r.name, {}});
    }
  }

  void run(Sweep& sweep) {
    for (GroundComparison& comparison : both_) comparison.frames.push_back(sweep.header.sequence);
    for (std::size_t i = 0; i < segmenters_.size(); ++i) {
      test::segment(*segmenters_[i], sweep);
      for (GroundComparison& comparison : both_)
        comparison.methods[i].counts.push_back(count_ground(comparison.protocol, sweep));
    }
  }

  void print(const std::string& where) const {
    for (const GroundComparison& comparison : both_)
      std::printf("\n%s, %s", where.c_str(), ground_table(comparison).c_str());
  }
  /// In percent, over all frames.
  double f1(std::size_t protocol, std::size_t method) const {
    return 100.0 * summarize_ground(both_[protocol].methods[method].counts).mean.f1;
  }

 private:
  static constexpr std::array kProtocols{GroundProtocol::kPatchwork, GroundProtocol::kPatchworkPlusPlus};
  std::vector<std::unique_ptr<ground::Segmenter>> segmenters_;
  std::array<GroundComparison, 2> both_;
};

void judge(Report& out, const Contest& contest) {
  constexpr double kMargin_percent = 1.0;
  constexpr Yardstick kFugSeg{95.7, 98.5};
  const std::vector<Row> all = rows();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const auto claim = [&](std::size_t protocol, double authors) {
      const std::string name =
          "ground accuracy: " + all[i].name + ", real scan, F1 by protocol " + (protocol == 0 ? "A" : "B");
      if (authors > 0.0) out.at_least(name, contest.f1(protocol, i), authors - kMargin_percent, " %");
      if (all[i].name == "patchwork-hdl64")
        out.shown(name + ", above FugSeg's",
                  format("%+.2f %%", contest.f1(protocol, i) - (protocol == 0 ? kFugSeg.a : kFugSeg.b)));
    };
    claim(0, all[i].authors.a);
    claim(1, all[i].authors.b);
  }
}

constexpr Mount kKitti{.height_m = 1.723};

void load_scan(Sweep& sweep) {
  KittiSource source(claims::recording("kitti/semantickitti_single"));
  if (!source.fill(sweep)) throw std::runtime_error("the scan cannot be read: " + source.complaint());
}

void on_real_scan(Report& out) {
  Contest contest(kKitti);
  Sweep sweep(KittiSource::kMaxPoints);
  load_scan(sweep);
  contest.run(sweep);
  contest.print("real scan");
  judge(out, contest);
}

/// By protocol B, in percent.
GroundScore score_b(const Sweep& sweep) {
  GroundScore score = ground_score(count_ground(GroundProtocol::kPatchworkPlusPlus, sweep));
  for (double* figure : {&score.precision, &score.recall, &score.f1}) *figure *= 100.0;
  return score;
}

/// What the plain references find on the real scan, and that they find what the authors' codes do, to a tenth
/// and a half of a percent, once they do one thing as those.
void account_for_differences(Report& out) {
  Sweep sweep(KittiSource::kMaxPoints);
  load_scan(sweep);
  const auto show = [&](const std::string& what, const test::Reference& reference,
                        std::optional<GroundScore> authors = {}) {
    const test::Mask mask = reference(sweep);
    std::copy(mask.begin(), mask.end(), sweep.ground.data());
    const GroundScore score = score_b(sweep);
    out.shown("ground accuracy: plain " + what + ", real scan, P / R / F1 by protocol B",
              format("%.1f / %.1f / %.1f %%", score.precision, score.recall, score.f1));
    if (authors)
      out.at_most("ground accuracy: plain " + what + ", off the authors' P, R and F1 by at most",
                  std::max({std::abs(score.precision - authors->precision),
                            std::abs(score.recall - authors->recall), std::abs(score.f1 - authors->f1)}),
                  0.15, " %");
  };
  GroundConfig c;
  c.gpf.planes = GpfConfig::Planes::kSlabs;
  show("linefit", test::linefit_reference(c.linefit, kKitti));
  show("linefit, a wide gap ends lines of two",
       test::linefit_reference(c.linefit, kKitti, test::WideGap::kEndsPairs), GroundScore{99.6, 66.4, 79.7});
  show("gpf slabs", test::gpf_reference(c.gpf, kKitti));
  show("gpf slabs, low returns left out", test::gpf_reference(c.gpf, kKitti, test::LowReturns::kLeftOut),
       GroundScore{99.1, 44.3, 61.3});
}

/// Moves a part of the ground's returns 1.2 to 2.5 times as far along their beams, where mirror images on a
/// wet road and second returns lie: below the ground. They are labelled outliers, so that only what the
/// method loses among the others counts.
void add_mirror_images(Sweep& sweep, double rate) {
  std::mt19937 random(1);
  std::uniform_real_distribution<float> chance(0.0F, 1.0F), factor(1.2F, 2.5F);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (!semantic_kitti::is_ground(sweep.label[i]) || !(chance(random) < static_cast<float>(rate))) continue;
    const float farther = factor(random);
    for (auto* coordinate : {&sweep.x_m, &sweep.y_m, &sweep.z_m}) (*coordinate)[i] *= farther;
    sweep.label[i] = semantic_kitti::kOutlier;
  }
}

void on_mirror_images(Report& out) {
  Sweep sweep(KittiSource::kMaxPoints);
  for (const char* const method : {"patchwork", "patchwork-hdl64", "patchworkpp", "lego"}) {
    GroundConfig config;
    config.method = method;
    std::string figures;
    for (const double percent : {0.0, 0.5, 2.0, 5.0}) {
      sweep.reset();
      load_scan(sweep);
      add_mirror_images(sweep, 0.01 * percent);
      test::segment(*ground::make_segmenter(config, kKitti, sweep.capacity()), sweep);
      const double f1 = score_b(sweep).f1;
      figures += format("%s%.1f", figures.empty() ? "" : " / ", f1);
      // The default method must bear a few.
      if (config.method == GroundConfig{}.method && percent <= 2.0)
        out.at_least(format("ground accuracy: patchwork, %g %% mirror images, F1 by protocol B", percent), f1,
                     95.0, " %");
    }
    out.shown("ground accuracy: " + config.method + ", 0 / 0.5 / 2 / 5 % mirror images, F1 by B",
              figures + " %");
  }
}

/// The default method, on ground that nobody chose its settings on.
void judge_default(Report& out, const Contest& contest, const std::string& where, double min_f1_percent) {
  for (const std::size_t protocol : {std::size_t{0}, std::size_t{1}})
    out.at_least("ground accuracy: patchwork, " + where + ", F1 by protocol " + (protocol == 0 ? "A" : "B"),
                 contest.f1(protocol, 0), min_f1_percent, " %");
}

/// Every fifth sweep of three drives in a world of the simulator.
Contest on_drives(SimulatedWorld world) {
  Contest contest{Mount{}};
  for (const int seed : {11, 12, 13}) {
    Config config;
    config.simulator.world = world;
    config.simulator.seed = seed;
    config.simulator.seconds = 3.0;
    config.simulator.start_speed_m_s = 10.0;
    SimulatorSource source(config.simulator, config.hdl64, config.mount);
    SweepReader reader(config, source, source.calibration());
    for (int i = 0; Sweep* sweep = reader.next(); ++i)
      if (i % 5 == 2 && sweep->header.is_posed()) contest.run(*sweep);
  }
  return contest;
}

void on_streets(Report& out) {
  const Contest contest = on_drives(SimulatedWorld::kUrban);
  contest.print("simulated streets");
  judge_default(out, contest, "simulated streets", 95.0);
}

/// Roads through hills, with bumpy verges, ditches and grass that lets a part of the beams through.
void on_hills(Report& out) {
  const Contest contest = on_drives(SimulatedWorld::kRural);
  contest.print("simulated hills with rough verges");
  judge_default(out, contest, "simulated hills with rough verges", 90.0);
}

/// A scene of the tests, not the simulator: a road that climbs, between verges whose bumps are sines of two
/// lengths, a wall and two cars, everything of exact geometry with 2 cm of noise.
void on_slope(Report& out) {
  Contest contest{Mount{}};
  Sweep sweep(test::kMaxReturns);
  for (const double grade : {-0.08, -0.04, 0.04, 0.08}) {
    const double at_wall_m = grade * 10.0;
    test::Scene()
        .ground(grade, 0.02)
        .bumps(0.15, 9.0, 4.0)
        .bumps(0.05, 1.7, 4.0)
        .box({-60, 14, -8}, {60, 15, 5})
        .box({8, -3.5, at_wall_m - 0.3}, {12, -1.8, at_wall_m + 1.5})
        .box({-14, 2.0, -at_wall_m - 0.5}, {-10, 3.7, -at_wall_m + 1.5})
        .scan(sweep, {.noise_m = 0.02});
    contest.run(sweep);
  }
  contest.print("slope with rough verge");
  judge_default(out, contest, "slope with rough verge", 95.0);
}

}  // namespace

int main() {
  return claims::run("ground accuracy", [](Report& out) {
    on_real_scan(out);
    account_for_differences(out);
    on_mirror_images(out);
    on_streets(out);
    on_hills(out);
    on_slope(out);
  });
}
