// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/csv.hpp"

#include "pago/core/error.hpp"
#include "support/catch.hpp"

namespace {

using Catch::Matchers::Contains;
using pago::CsvTable;

TEST_CASE("cells are found by the name of their column", "[core][csv]") {
  const CsvTable table = CsvTable::parse("a,b_ms,c\n1,2.5,x\n-3,,y\n", "t.csv");
  CHECK(table.num_rows() == 2);
  CHECK(table.at("b_ms") == 1);
  CHECK_FALSE(table.find("d"));
  CHECK(table.number(0, 1) == 2.5);
  CHECK(table.integer(1, 0) == -3);
  CHECK(table.text(1, 1).empty());
  CHECK(table.text(1, 2) == "y");
  CHECK(CsvTable::parse("a,b\r\n1,2\r\n", "t.csv").count(0, 1) == 2);
  CHECK(CsvTable::parse("a,b\n", "t.csv").num_rows() == 0);
}

TEST_CASE("a last line that was cut off is left out", "[core][csv]") {
  const CsvTable table = CsvTable::parse("a,b\n1,2\n3,4\n5", "t.csv");
  CHECK(table.num_rows() == 2);
  CHECK(CsvTable::parse("a,b\n1,2\n3,4", "t.csv").num_rows() == 1);
}

TEST_CASE("what is no table is refused with its line", "[core][csv]") {
  CHECK_THROWS_WITH(CsvTable::parse("", "t.csv"), Contains("t.csv: has no line"));
  CHECK_THROWS_WITH(CsvTable::parse("a,b\n1,2\n1,2,3\n", "t.csv"), Contains("t.csv:3: has 3 cells"));
  CHECK_THROWS_WITH(CsvTable::parse("a\n1\n", "t.csv").at("b"), Contains("t.csv: has no column \"b\""));
  const CsvTable table = CsvTable::parse("a,b\n1x,-1\n", "t.csv");
  CHECK_THROWS_WITH(table.number(0, 0), Contains("t.csv:2: a is \"1x\", not a number"));
  CHECK_THROWS_AS(table.count(0, 1), pago::Error);
  CHECK_THROWS_WITH(CsvTable::read("/nowhere/t.csv"), Contains("/nowhere/t.csv: cannot be opened"));
}

}  // namespace
