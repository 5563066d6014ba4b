// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_report.hpp"

#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::evaluation;
using Catch::Matchers::Contains;

constexpr auto kA = GroundProtocol::kPatchwork;
constexpr auto kB = GroundProtocol::kPatchworkPlusPlus;

GroundCounts counts(GroundProtocol protocol, std::uint64_t tp, std::uint64_t fp, std::uint64_t fn) {
  return {.protocol = protocol,
          .true_positive = tp,
          .false_positive = fp,
          .false_negative = fn,
          .true_negative = 5,
          .excluded = 2};
}

/// Two frames: precision 0.5 and 1.0, recall 1.0 and 0.8.
GroundComparison comparison(GroundProtocol protocol = kA) {
  return {.protocol = protocol,
          .frames = {3, 7},
          .methods = {{"lawn", {counts(protocol, 10, 10, 0), counts(protocol, 80, 0, 20)}}}};
}

std::size_t times(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST_CASE("the table has means, spread over the frames, and all points together", "[evaluation][ground]") {
  const std::string table = ground_table(comparison());
  CHECK_THAT(table, Contains("protocol A (Patchwork)"));
  CHECK_THAT(table, Contains("2 frames"));
  // F1: 2/3 and 8/9, deviation 1/9; together 90 of 90 + (10 + 20) / 2.
  CHECK_THAT(table, Contains("lawn             75.00 +- 25.00  90.00 +- 10.00  77.78 +- 11.11"));
  CHECK_THAT(table, Contains("90.00   81.82   85.71\n"));
}

TEST_CASE("the rows have each frame's counts and scores", "[evaluation][ground]") {
  const std::string csv = ground_csv(comparison());
  CHECK(times(csv, "\n") == 3);
  CHECK_THAT(csv, Contains("\nlawn,3,10,10,0,5,2,0.500000,1.000000,0.666667\n"));
  CHECK_THAT(csv, Contains("\nlawn,7,80,0,20,5,2,1.000000,0.800000,0.888889\n"));
}

TEST_CASE("a page plots precision and recall of every method, each protocol apart", "[evaluation][ground]") {
  GroundComparison a = comparison(kA);
  a.methods.push_back({"<moss>", {counts(kA, 9, 0, 1), counts(kA, 9, 1, 0)}});
  const std::vector both{a, comparison(kB)};
  const std::string page = ground_page("sweeps & scans", both);
  CHECK_THAT(page, Contains("<h1>sweeps &amp; scans</h1>"));
  CHECK_THAT(page, Contains("&lt;moss>"));
  CHECK(times(page, "<moss>") == 0);
  CHECK(times(page, "Precision, %") == 2);
  CHECK(times(page, "Recall, %") == 2);
  CHECK(times(page, "<circle") == 2 * 2 * 2 + 2 * 2);  // figures x methods x frames
  CHECK(times(page, "<h2>Protocol") == 2);
  CHECK(page.find("Protocol A") < page.find("Protocol B"));
  CHECK_THAT(page, Contains(">50</text>"));  // the axis begins at the worst precision
  CHECK(times(page, "<svg") == times(page, "</svg>"));
}

TEST_CASE("what is not defined is n/a, and no dot in the plot", "[evaluation][ground]") {
  GroundComparison a = comparison();
  a.frames.push_back(8);
  a.methods[0].counts.push_back({.protocol = kA, .true_negative = 4, .excluded = 9});  // no ground
  a.methods.push_back({"none", {counts(kA, 0, 0, 10), counts(kA, 0, 0, 100), counts(kA, 0, 0, 0)}});
  const std::string table = ground_table(a);
  CHECK_THAT(table, Contains("2 frames, and 1 without ground"));
  CHECK_THAT(table, Contains("lawn             75.00 +- 25.00  90.00 +- 10.00  77.78 +- 11.11"));
  CHECK_THAT(table, Contains("none               n/a +-  n/a   0.00 +- 0.00   0.00 +- 0.00        n/a"));
  CHECK_THAT(ground_csv(a), Contains("\nlawn,8,0,0,0,4,9,n/a,n/a,n/a\n"));
  const std::string page = ground_page("", std::vector{a});
  CHECK_THAT(page, Contains("<td>n/a &plusmn; n/a<td>0.00") && Contains("1 without ground"));
  CHECK(times(page, "<circle") == 2 + 2 + 2);  // no precision of none, no recall without ground
  CHECK(times(page, "nan") == 0);
}

TEST_CASE("protocols are never mixed, and every frame is counted", "[evaluation][ground]") {
  GroundComparison wrong = comparison(kA);
  wrong.protocol = kB;
  CHECK_THROWS_WITH(ground_table(wrong), Contains("other protocol"));
  GroundComparison mixed = comparison(kA);
  mixed.methods[0].counts[1] = counts(kB, 1, 0, 0);
  CHECK_THROWS_WITH(ground_csv(mixed), Contains("cannot be summarised together"));
  GroundComparison missing = comparison();
  missing.frames.push_back(9);
  CHECK_THROWS_WITH(ground_page("", std::vector{missing}), Contains("2 counts for 3 frames"));
}

}  // namespace
