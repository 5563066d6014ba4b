// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::test;
using Catch::Matchers::Contains;

TEST_CASE("a capture becomes a mask per sweep and method, coloured on request", "[app][segment]") {
  const StreetFolder folder(2);
  const Outcome outcome =
      run_pago(folder.path(), "segment street.pcap --ground patchwork,none --ply --pictures --output masks");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK_THAT(outcome.out, Contains("none              0.00 % ground"));
  const fs::path latest = folder.path() / "masks" / "latest";
  const std::string mask = read_text(latest / "patchwork" / "000000.mask");
  const std::string none = read_text(latest / "none" / "000000.mask");
  const auto num_ground = static_cast<std::size_t>(std::count(mask.begin(), mask.end(), '\1'));
  CHECK(mask.size() > 50'000);
  CHECK(none == std::string(mask.size(), '\0'));
  CHECK(num_ground > mask.size() / 10);
  CHECK(num_ground + static_cast<std::size_t>(std::count(mask.begin(), mask.end(), '\0')) == mask.size());
  const std::string ply = read_text(latest / "patchwork" / "000000.ply");
  CHECK_THAT(ply, Contains("element vertex " + std::to_string(mask.size()) + "\n"));
  CHECK_THAT(read_text(latest / "patchwork" / "000001.png"), Contains("PNG"));
  CHECK_FALSE(fs::exists(latest / "index.html"));  // no labels, no scores
}

TEST_CASE("labelled scans are scored by both protocols, with a page", "[app][segment]") {
  PAGO_DATA_OR_SKIP(scans, "kitti/semantickitti_single");
  const StreetFolder folder(1);
  const Outcome outcome = run_pago(
      folder.path(), "segment '" + scans.string() + "' --ground patchwork,truth --set mount.height_m=1.723");
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out.find("protocol A (Patchwork)") < outcome.out.find("protocol B (Patchwork++)"));
  CHECK_THAT(outcome.out, Contains("truth           100.00 +- 0.00 100.00 +- 0.00 100.00 +- 0.00"));
  const fs::path latest = folder.path() / "segments" / "latest";
  CHECK(fs::file_size(latest / "patchwork" / "000000.mask") ==
        fs::file_size(scans / "velodyne" / "000000.bin") / 16);
  CHECK(count_lines(read_text(latest / "protocol_a.csv")) == 3);
  CHECK(count_lines(read_text(latest / "protocol_b.csv")) == 3);
  CHECK_THAT(read_text(latest / "index.html"),
             Contains("Precision over the drive") && Contains("protocol B"));
  CHECK(outcome.err == "");

  SECTION("what is true does not depend on the mount's height") {
    const auto lego_row = [&](const std::string& height_m) {
      run_pago(folder.path(), "segment '" + scans.string() +
                                  "' --ground lego --output lego --set mount.height_m=" + height_m);
      return read_text(folder.path() / "lego" / "latest" / "protocol_a.csv");
    };
    CHECK(lego_row("1.723") == lego_row("1.2"));
  }
}

TEST_CASE("a mount that one scan contradicts is warned about at its end", "[app][segment]") {
  PAGO_DATA_OR_SKIP(scans, "kitti/semantickitti_single");
  const StreetFolder folder(1);
  const auto complaint_with = [&](const std::string& settings) {
    return run_pago(folder.path(), "segment '" + scans.string() + "' " + settings).err;
  };
  CHECK_THAT(complaint_with("--set mount.height_m=0.9"), Contains("mount.height_m is 0.90; try"));
  CHECK_THAT(complaint_with("--set mount.roll_rad=3.1416"), Contains("upside down"));
  CHECK_THAT(complaint_with("--set mount.roll_rad=1.5708"), Contains("x forward, y left, z up"));
}

TEST_CASE("an estimated height is shown", "[app][segment]") {
  const StreetFolder folder(2);
  const Outcome outcome = run_pago(
      folder.path(), "segment street.pcap --set mount.height_m=1.6 --set ground.height.enabled=true");
  CHECK_THAT(outcome.out, Contains("height    1.7") && Contains("mount.height_m is 1.60"));
}

TEST_CASE("an interrupted comparison says that it is of a part", "[app][segment]") {
  PAGO_DATA_OR_SKIP(drive, "packets/drive_0005");
  const StreetFolder folder(1);
  RunningProgram program(folder.path(), {"segment", (drive / "drive_0005.pcap").string()});
  program.wait_for("segments/latest/patchwork/000001.mask");
  CHECK(program.interrupt() == 0);
  CHECK_THAT(read_text(folder.path() / "err.txt"),
             Contains("stopped by a signal: masks and scores are of the first "));
}

TEST_CASE("what cannot be segmented is refused in one line", "[app][segment]") {
  const StreetFolder folder(1);
  const auto segment = [&](const std::string& arguments) {
    return run_pago(folder.path(), "segment " + arguments);
  };
  require_one_line_and_code_2(segment("missing.pcap"), "missing.pcap");
  require_one_line_and_code_2(segment("street.pcap --ground patchwork,lawn"), "lawn");
  require_one_line_and_code_2(segment("street.pcap --ground lego,patchwork,lego"), "names lego twice");
  require_one_line_and_code_2(segment("street.pcap --ground 'lego, lego'"), "names lego twice");
  require_one_line_and_code_2(segment("street.pcap --sweeps -1"), "--sweeps");
  require_one_line_and_code_2(
      segment("street.pcap --ground cascaded --set ground.cascaded.min_range_m=20 --set "
              "ground.cascaded.max_range_m=5"),
      "ground.cascaded.min_range_m is 20.0, ground.cascaded.max_range_m is 5.0");
  require_one_line_and_code_2(segment("street.pcap --ground patchwork,truth"), "has no labels");
  require_one_line_and_code_2(segment("udp://127.0.0.1:0 --calibration calibration.yaml"), "is live");
  require_one_line_and_code_2(segment("udp://127.0.0.1:0"), "is live");  // without waiting for a calibration
  CHECK_FALSE(fs::exists(folder.path() / "segments"));
}
