// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/preset.hpp"

#include "messages.hpp"
#include "pago/config/load.hpp"
#include "src/config/settings.hpp"
#include "support/catch.hpp"

namespace pago {
namespace {

Config with(Preset preset) {
  Config config;
  apply_preset(config, preset);
  return config;
}

TEST_CASE("each preset is a valid configuration of its own, and the default changes nothing",
          "[config][preset]") {
  CHECK(dump_toml(with(Preset::kDefault)) == dump_toml({}));
  CHECK(dump_toml(with(Preset::kPaperCode)) != dump_toml(with(Preset::kPaperText)));
  for (const auto& [name, preset] : preset_choices().words) {
    CAPTURE(name);
    CHECK(preset_of(name) == preset);
    CHECK_NOTHROW(validate(with(preset)));
  }
}

TEST_CASE("paper-code has the numbers of the paper's code, paper-text differs where the text does",
          "[config][preset]") {
  const Config code = with(Preset::kPaperCode), text = with(Preset::kPaperText);
  CHECK(code.odometry.update_gain == 0.05);
  CHECK(text.odometry.update_gain == 1.0);
  CHECK(code.features.planar_source == PlanarSource::kGroundOnly);
  CHECK(text.features.planar_source == PlanarSource::kBoth);
  CHECK(code.features.clustering.neighbours == Neighbours::kDiagonal);
  CHECK(text.features.clustering.neighbours == Neighbours::kFour);
  for (const Config& paper : {code, text}) {
    CHECK(paper.features.projection == Projection::kUniform);
    CHECK_FALSE(paper.odometry.deskew);
    CHECK(paper.mapping.method == MappingMethod::kKeyframes);
    CHECK(paper.ground.patchwork.low_cut_below_ground_m == Approx(0.8 * 1.723).margin(1e-3));
  }
}

TEST_CASE("in a file the preset comes first wherever it stands, and other settings change it",
          "[config][preset]") {
  Config config;
  apply_toml(config, "odometry.update_gain = 0.5\npreset = \"paper-code\"", "f.toml");
  CHECK(config.preset == Preset::kPaperCode);
  CHECK(config.odometry.update_gain == 0.5);
  CHECK(config.odometry.registration == Registration::kLoam);

  Config loaded;
  apply_toml(loaded, dump_toml(config), "dump");
  CHECK(dump_toml(loaded) == dump_toml(config));
}

TEST_CASE("as an assignment a preset is applied in its turn", "[config][preset]") {
  Config config;
  set(config, "odometry.update_gain=0.5");
  set(config, "preset=paper-code");
  CHECK(config.odometry.update_gain == 0.05);
  set(config, "odometry.update_gain=0.7");
  CHECK(config.odometry.update_gain == 0.7);
}

TEST_CASE("an unknown preset is refused with those that there are", "[config][preset]") {
  CHECK(test::complaint_of([] { preset_of("paper"); }) ==
        "preset: 'paper' is none (there are default, paper-code, paper-text)");
  CHECK(test::complaint_of([] {
          Config config;
          set(config, "preset=paper");
        }) ==
        "preset=paper: preset must be one of \"default\", \"paper-code\", \"paper-text\", is \"paper\"");
}

TEST_CASE("what a preset shows of itself is what it sets", "[config][preset]") {
  Config shown;
  apply_toml(shown, preset_toml(Preset::kPaperCode), "shown");
  shown.preset = Preset::kPaperCode;
  CHECK(dump_toml(shown) == dump_toml(with(Preset::kPaperCode)));
}

}  // namespace
}  // namespace pago
