// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "page/markup.hpp"

namespace {

using namespace pago::test;
using Catch::Matchers::Contains;

TEST_CASE("drives are compared on the terminal, as JSON and on a page", "[app][compare]") {
  const StreetFolder folder(4);
  const Outcome table =
      run_pago(folder.path(), "compare street.pcap street.pcap --sweeps 2 --html page.html");
  INFO(table.err);
  REQUIRE(table.exit_code == 0);
  CHECK_THAT(table.out, Contains("[1] street.pcap, 2 sweeps\n[2] street.pcap, 2 sweeps\n"));
  const std::string page = read_text(folder.path() / "page.html");
  CHECK(misplaced_tag(page) == "");
  CHECK_FALSE(fetches(page));

  const Outcome json = run_pago(folder.path(), "compare street.pcap --json");
  REQUIRE(json.exit_code == 0);
  const auto drive = nlohmann::json::parse(json.out).at("drives").at(0);
  CHECK(drive.at("sweeps") >= 3);
  CHECK(drive.at("figures").at("ground_percent") > 10.0);
  // One sweep lies on the other: they are placed and de-skewed right.
  CHECK(drive.at("figures").at("overlap_mm") < 20.0);
}

TEST_CASE("a drive that cannot be read is named", "[app][compare]") {
  const StreetFolder folder(1);
  require_one_line_and_code_2(run_pago(folder.path(), "compare street.pcap nowhere.pcap"), "nowhere.pcap");
  require_one_line_and_code_2(run_pago(folder.path(), "compare"), "sources");
}

}  // namespace
