// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The simulator against itself: a wall and level ground, seen in a bend at 12 m/s.
#include "tests/claims/report.hpp"
#include "tests/simulator/wall_flatness.hpp"

using namespace pago;
using claims::Report;
using simulator::Label;
using test::Flatness;
using test::WallScene;

namespace {

constexpr double kNoise_m = 0.015;
/// Half a distance step is what rounding does; the rest is for single precision in decoder and ray caster.
constexpr double kMaxSteps = 0.65;

Flatness seen(const WallScene::Settings& settings, Label label, bool deskews) {
  WallScene scene(settings);
  const Flatness result = flatness(scene, label, deskews);
  if (result.count < 5000) throw std::runtime_error("too little of the wall was seen");
  return result;
}

std::uint64_t differing_packets() {
  WallScene::Settings settings{.noise_m = kNoise_m, .packets = 100};
  WallScene first(settings), second(settings);
  const auto a = first.packets(), b = second.packets();
  std::uint64_t different = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    different += a[i].bytes == b[i].bytes && a[i].labels == b[i].labels ? 0U : 1U;
  return different;
}

}  // namespace

int main() {
  return claims::run("simulator", [](Report& report) {
    report.at_most("simulator: decoded wall from the cast one, worst return, along the beam",
                   seen({}, Label::kBuilding, true).worst_steps, kMaxSteps, " steps of 2 mm");
    report.at_most("simulator: decoded ground from the cast one, worst return, along the beam",
                   seen({}, Label::kRoad, true).worst_steps, kMaxSteps, " steps of 2 mm");
    report.at_most("simulator: wall without noise, exactly de-skewed, rms",
                   seen({}, Label::kBuilding, true).rms_m, 0.001, " m");
    const WallScene::Settings noisy{.noise_m = kNoise_m};
    report.at_most(format("simulator: wall with %.3f m of noise, exactly de-skewed, rms", kNoise_m),
                   seen(noisy, Label::kBuilding, true).rms_m, 1.3 * kNoise_m, " m");
    report.at_least("simulator: the same wall before de-skew, rms",
                    seen(noisy, Label::kBuilding, false).rms_m, 0.3, " m");
    report.exactly("simulator: packets that differ between two runs of one seed", differing_packets(), 0);
  });
}
