// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_report.hpp"

#include <filesystem>
#include <fstream>

#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

namespace {

using namespace pago::evaluation;
using Catch::Matchers::Contains;
using pago::test::TemporaryPath;

constexpr auto kPatchworkRules = GroundProtocol::kPatchwork;
constexpr auto kPlusPlusRules = GroundProtocol::kPatchworkPlusPlus;

GroundCounts counts(GroundProtocol protocol, std::uint64_t tp, std::uint64_t fp, std::uint64_t fn) {
  return {.protocol = protocol,
          .true_positive = tp,
          .false_positive = fp,
          .false_negative = fn,
          .true_negative = 5,
          .excluded = 2};
}

/// Two frames: precision 0.5 and 1.0, recall 1.0 and 0.8.
GroundComparison comparison(GroundProtocol protocol = kPatchworkRules) {
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

TEST_CASE("what was counted is read back", "[evaluation][ground]") {
  const TemporaryPath folder("segments");
  std::filesystem::create_directory(folder.path());
  CHECK_THROWS_WITH(read_ground_folder(folder.path()), Contains("holds no counts"));
  GroundComparison written = comparison(kPlusPlusRules);
  written.methods.push_back({"moss", {counts(kPlusPlusRules, 9, 0, 1), counts(kPlusPlusRules, 9, 1, 0)}});
  std::ofstream(folder.path() / ground_csv_name(kPlusPlusRules)) << ground_csv(written);
  const std::vector<GroundComparison> read = read_ground_folder(folder.path());
  REQUIRE(read.size() == 1);
  CHECK(read[0].protocol == kPlusPlusRules);
  CHECK(read[0].frames == written.frames);
  REQUIRE(read[0].methods.size() == 2);
  CHECK(read[0].methods[1].method == "moss");
  CHECK(ground_csv(read[0]) == ground_csv(written));
}

TEST_CASE("rows of other frames than the first method's are refused with their line",
          "[evaluation][ground]") {
  const TemporaryPath file("protocol_a.csv");
  const std::string names =
      "method,frame,true_positive,false_positive,false_negative,true_negative,excluded\n";
  const auto read = [&](const std::string& rows) {
    std::ofstream(file.path()) << names << rows;
    return read_ground_csv(file.path(), kPatchworkRules);
  };
  CHECK(read("a,1,1,1,1,1,0\na,2,1,1,1,1,0\nb,1,1,1,1,1,0\nb,2,1,1,1,1,0\n").methods.size() == 2);
  CHECK_THROWS_WITH(read("a,1,1,1,1,1,0\nb,2,1,1,1,1,0\n"), Contains(":3: the methods were not"));
  CHECK_THROWS_WITH(read("a,1,1,1,1,1,0\nb,1,1,1,1,1,0\nb,2,1,1,1,1,0\n"),
                    Contains(":4: the methods were not"));
  CHECK_THROWS_WITH(read("a,1,1,1,1,1,0\na,2,1,1,1,1,0\nb,1,1,1,1,1,0\n"), Contains("1 counts for 2 frames"));
  CHECK_THROWS_WITH(read("a,1,-1,1,1,1,0\n"), Contains(":2"));
}

TEST_CASE("what is not defined is n/a", "[evaluation][ground]") {
  GroundComparison a = comparison();
  a.frames.push_back(8);
  a.methods[0].counts.push_back(
      {.protocol = kPatchworkRules, .true_negative = 4, .excluded = 9});  // no ground
  a.methods.push_back({"none",
                       {counts(kPatchworkRules, 0, 0, 10), counts(kPatchworkRules, 0, 0, 100),
                        counts(kPatchworkRules, 0, 0, 0)}});
  const std::string table = ground_table(a);
  CHECK_THAT(table, Contains("2 frames, and 1 without ground"));
  CHECK_THAT(table, Contains("lawn             75.00 +- 25.00  90.00 +- 10.00  77.78 +- 11.11"));
  CHECK_THAT(table, Contains("none               n/a +-  n/a   0.00 +- 0.00   0.00 +- 0.00        n/a"));
  CHECK_THAT(ground_csv(a), Contains("\nlawn,8,0,0,0,4,9,n/a,n/a,n/a\n"));
}

TEST_CASE("protocols are never mixed, and every frame is counted", "[evaluation][ground]") {
  GroundComparison wrong = comparison(kPatchworkRules);
  wrong.protocol = kPlusPlusRules;
  CHECK_THROWS_WITH(ground_table(wrong), Contains("other protocol"));
  GroundComparison mixed = comparison(kPatchworkRules);
  mixed.methods[0].counts[1] = counts(kPlusPlusRules, 1, 0, 0);
  CHECK_THROWS_WITH(ground_csv(mixed), Contains("cannot be summarised together"));
  GroundComparison missing = comparison();
  missing.frames.push_back(9);
  CHECK_THROWS_WITH(ground_table(missing), Contains("2 counts for 3 frames"));
}

}  // namespace
