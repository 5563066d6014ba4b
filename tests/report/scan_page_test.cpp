// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/scan_page.hpp"

#include "page/markup.hpp"
#include "support/catch.hpp"
#include "support/scene.hpp"

namespace {

using namespace pago;
using namespace pago::test;
using Catch::Matchers::Contains;

evaluation::ScannedDrive drive_of(const std::string& name, double wall_at_m) {
  Sweep sweep(kNumRings * 2083);
  Scene scene;
  scene.level_ground().box({wall_at_m, -40, -1}, {wall_at_m + 1, 40, 30});
  std::ranges::copy(scene.scan(sweep), sweep.ground.begin());
  evaluation::ScannedDrive drive{name, {}};
  add_returns(sweep, drive.statistics);
  add_ground_patches(sweep, drive.statistics);
  add_surfaces(sweep, drive.statistics);
  return drive;
}

TEST_CASE("drives lie over each other on a page of one file", "[report][page]") {
  const std::string html =
      report::scan_page({drive_of("real & old", 15.0), drive_of("simulated", 25.0)}, "pago compare a b");
  CHECK(misplaced_tag(html) == "");
  CHECK_FALSE(fetches(html));
  CHECK_THAT(html, Contains("real &amp; old") && !Contains("real & old") && Contains("pago compare a b"));
  for (const char* title : {"Returns per ring", "Ranges", "Ground by range", "Ground from its planes",
                            "Range noise by incidence", "Distance from the sweep before",
                            "Dropout by incidence", "Intensity of ground", "Intensity of all else"})
    CHECK_THAT(html, Contains("<h3>" + std::string(title) + "</h3>"));
  const std::string rings = html.substr(html.find("<h3>Returns per ring</h3>"));
  CHECK(times(rings.substr(0, rings.find("</figure>")), "<polyline") == 2);
}

}  // namespace
