// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/run.hpp"
#include "support/catch.hpp"

namespace {

using pago::report::short_names;
using Names = std::vector<std::string>;

TEST_CASE("runs are called by what tells their paths apart", "[report][names]") {
  CHECK(short_names({"results/a/trajectory.tum", "results/b/trajectory.tum"}) == Names{"a", "b"});
  CHECK(short_names({"out/a/latest/", "out/b/latest"}) == Names{"a", "b"});
  CHECK(short_names({"x/a.txt", "x/y/a.txt"}) == Names{"a.txt", "y/a.txt"});
  CHECK(short_names({"/data/run/trajectory.tum"}) == Names{"trajectory.tum"});
  CHECK(short_names({"a.tum", "a.tum"}) == Names{"a.tum", "a.tum"});
}

}  // namespace
