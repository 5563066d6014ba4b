// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "app/program.hpp"
#include "page/markup.hpp"

namespace {

using namespace pago::test;
using Catch::Matchers::Contains;

TEST_CASE("a source is run and profiled, two runs are compared, on the terminal and on a page",
          "[app][profile]") {
  const StreetFolder folder(6);
  const auto pago = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  const Outcome first = pago("profile street.pcap --output a --html a.html");
  INFO(first.err);
  REQUIRE(first.exit_code == 0);
  CHECK_THAT(first.out,
             Contains("odometry      cpu") && Contains("all stages    cpu") && Contains("a replay"));
  REQUIRE(pago("run street.pcap --output b --ground lego").exit_code == 0);
  CHECK_THAT(pago("profile a/latest").out, Contains("ground        run"));
  const Outcome both = pago("profile --compare a/latest b/latest --html both.html");
  REQUIRE(both.exit_code == 0);
  CHECK_THAT(both.out, Contains("run       a of street.pcap") && Contains("run       b of street.pcap") &&
                           Contains("slower in"));
  for (const char* const file : {"a.html", "both.html"}) {
    const std::string page = read_text(folder.path() / file);
    CHECK(misplaced_tag(page) == "");
    CHECK_FALSE(fetches(page));
  }
}

TEST_CASE("a live run's profile has waits, times to the poses and deadlines", "[app][profile]") {
  const StreetFolder folder(6);
  const Outcome run = run_pago(folder.path(), "profile street.pcap --realtime --deadline 10000");
  INFO(run.err);
  REQUIRE(run.exit_code == 0);
  CHECK_THAT(run.out, Contains("refined pose  wall") && Contains("later than 10000 ms, or none: ") &&
                          Contains("odometry      wait"));
}

TEST_CASE("profile refuses what it cannot use", "[app][refusals]") {
  const StreetFolder folder(1);
  const auto pago = [&](const std::string& arguments) { return run_pago(folder.path(), arguments); };
  fs::create_directories(folder.path() / "empty");
  fs::create_directories(folder.path() / "cut");
  std::ofstream(folder.path() / "cut" / "run.json") << "{}";
  require_one_line_and_code_2(pago("profile missing.pcap"), "missing.pcap");
  require_one_line_and_code_2(pago("profile --compare empty empty"), "is not the results folder of a run");
  require_one_line_and_code_2(pago("profile --compare cut cut"), "latency.csv");
  CHECK(pago("profile").exit_code == 2);
  CHECK(pago("profile street.pcap --compare a b").exit_code == 2);
  CHECK(pago("profile street.pcap --deadline 0").exit_code == 2);
}

}  // namespace
