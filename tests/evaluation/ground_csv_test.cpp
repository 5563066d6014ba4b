// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/evaluation/ground_csv.hpp"

#include <fstream>

#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

namespace {

using namespace pago::evaluation;
using Catch::Matchers::Contains;
using pago::test::TemporaryPath;

const GroundRow kRow{7, "patchwork", {GroundProtocol::kPatchworkPlusPlus, 90, 10, 30, 70, 0}};

std::vector<GroundRow> read(const std::string& text) {
  const TemporaryPath file("ground.csv");
  std::ofstream(file.path()) << text;
  return read_ground_csv(file.path());
}

TEST_CASE("what was counted is read back", "[evaluation][ground_csv]") {
  CHECK(ground_csv_line(kRow) == "7,patchwork,B,90,10,30,70");
  const auto rows = read(std::string(ground_csv_header()) + "\n" + ground_csv_line(kRow) + "\n");
  REQUIRE(rows.size() == 1);
  CHECK(rows[0].frame == 7);
  CHECK(rows[0].method == "patchwork");
  CHECK(rows[0].counts.protocol == GroundProtocol::kPatchworkPlusPlus);
  CHECK(ground_score(rows[0].counts).precision == Approx(0.9));
  CHECK(ground_score(rows[0].counts).recall == Approx(0.75));
}

TEST_CASE("a file of one method need not name it", "[evaluation][ground_csv]") {
  const auto rows = read("frame,protocol,tp,fp,fn,tn\n0,A,1,2,3,4\n1,A,5,6,7,8\n");
  REQUIRE(rows.size() == 2);
  CHECK(rows[1].method.empty());
  CHECK(rows[1].counts.true_negative == 8);
}

TEST_CASE("methods and protocols are kept apart", "[evaluation][ground_csv]") {
  const auto series =
      ground_series(read("frame,method,protocol,tp,fp,fn,tn\n0,a,A,1,2,3,4\n0,a,B,1,2,3,4\n"
                         "0,b,A,1,2,3,4\n1,a,A,5,6,7,8\n"));
  REQUIRE(series.size() == 3);
  CHECK(series[0].method == "a");
  CHECK(series[0].frames == std::vector<std::uint64_t>{0, 1});
  CHECK(series[1].protocol == GroundProtocol::kPatchworkPlusPlus);
  CHECK(series[2].method == "b");
}

TEST_CASE("what is no such file is refused with its line", "[evaluation][ground_csv]") {
  CHECK_THROWS_WITH(read("frame,protocol,tp,fp,fn\n"), Contains("no column \"tn\""));
  CHECK_THROWS_WITH(read("frame,protocol,tp,fp,fn,tn\n0,C,1,2,3,4\n"), Contains(":2: protocol is \"C\""));
  CHECK_THROWS_WITH(read("frame,protocol,tp,fp,fn,tn\n0,A,1,-2,3,4\n"), Contains(":2: fp is \"-2\""));
}

}  // namespace
