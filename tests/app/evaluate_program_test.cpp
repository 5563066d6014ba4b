// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"
#include "page/markup.hpp"

namespace {

using namespace pago::test;
using Catch::Matchers::Contains;

TEST_CASE("a run and the baseline are compared, on the terminal and on a page", "[app][evaluate]") {
  const StreetFolder folder(6);
  const auto pago = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  REQUIRE(pago("run street.pcap").exit_code == 0);
  const Outcome baseline = pago("baseline street.pcap");
  REQUIRE(baseline.exit_code == 0);
  CHECK_THAT(baseline.out, Contains("ms of CPU each"));
  const fs::path poses = folder.path() / "baselines" / "latest" / "trajectory.tum";
  CHECK(count_lines(read_text(poses)) ==
        count_lines(read_text(folder.path() / "results" / "latest" / "trajectory.tum")));
  // Both have a pose for the same instants.
  CHECK(read_text(poses).substr(0, 20) ==
        read_text(folder.path() / "results" / "latest" / "trajectory.tum").substr(0, 20));

  const Outcome both = pago(
      "evaluate results/latest/odometry.tum results/latest baselines/latest --lengths 1 --step 1 --html "
      "page.html");
  INFO(both.err);
  REQUIRE(both.exit_code == 0);
  CHECK_THAT(both.out,
             Contains("1: results/latest") && Contains("2: baselines/latest") && Contains("t_rel, %"));
  const std::string page = read_text(folder.path() / "page.html");
  CHECK(misplaced_tag(page) == "");
  CHECK_FALSE(fetches(page));
  CHECK_THAT(page, Contains("CPU of all stages") && Contains("class=\"best\""));

  // Both folders say at which instants their poses hold, so that a truth at another one can be used by row.
  const Outcome at_mid = pago(
      "evaluate results/latest/odometry.kitti results/latest baselines/latest --truth-at mid --lengths 1 "
      "--step 1");
  INFO(at_mid.err);
  REQUIRE(at_mid.exit_code == 0);
  CHECK_THAT(at_mid.out, Contains("truth carried on by +0.5 rows"));
}

TEST_CASE("KITTI rows are matched by the stamps of a times file", "[app][evaluate]") {
  const TemporaryPath folder("");
  fs::create_directories(folder.path());
  const auto write = [&](const char* name, const std::string& text) {
    std::ofstream(folder.path() / name) << text;
  };
  write("rows.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n1 0 0 1 0 1 0 0 0 0 1 0\n1 0 0 2 0 1 0 0 0 0 1 0\n");
  write("times.txt", "5.0\n5.1\n5.2\n");
  write("drive.tum", "5.1 0 0 0 0 0 0 1\n5.2 1 0 0 0 0 0 1\n");
  const auto pago = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  const Outcome truth_timed = pago("evaluate rows.txt drive.tum --truth-times times.txt");
  CHECK_THAT(truth_timed.out, Contains("2 of 3 rows, by stamp"));
  const Outcome estimate_timed = pago("evaluate drive.tum rows.txt --estimate-times times.txt");
  CHECK_THAT(estimate_timed.out, Contains("2 of 2 rows, by stamp"));
  require_one_line_and_code_2(pago("evaluate rows.txt drive.tum --match stamp"), "--truth-times");
  require_one_line_and_code_2(pago("evaluate drive.tum drive.tum --truth-times times.txt"),
                              "has stamps of its own");
}

TEST_CASE("evaluate and baseline refuse what they cannot use", "[app][refusals]") {
  const StreetFolder folder(1);
  const auto pago = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  std::ofstream(folder.path() / "a.tum") << "1 0 0 0 0 0 0 1\n2 1 0 0 0 0 0 1\n";
  fs::create_directories(folder.path() / "empty");
  require_one_line_and_code_2(pago("baseline udp://:2999 --calibration calibration.yaml"), "is live");
  require_one_line_and_code_2(pago("baseline missing.pcap"), "missing.pcap");
  require_one_line_and_code_2(pago("evaluate a.tum a.tum --ground empty"), "--html");
  require_one_line_and_code_2(pago("evaluate a.tum a.tum --html page.html --ground empty"),
                              "holds no counts");
  require_one_line_and_code_2(pago("evaluate a.tum empty"), "empty/trajectory.tum");
  require_one_line_and_code_2(pago("evaluate a.tum a.tum --html missing/page.html"), "missing/page.html");
}

}  // namespace
