// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/pipeline/backlog.hpp"

#include <string>
#include <vector>

#include "support/catch.hpp"

using namespace pago;

namespace {

/// What becomes of the next sweeps: o worked on, x passed over.
std::string begin(Backlog& backlog, int count) {
  static std::uint64_t sequence = 0;
  std::string fates;
  for (int i = 0; i < count; ++i) fates += backlog.passes_over(sequence++) ? 'x' : 'o';
  return fates;
}
void arrive(Backlog& backlog, int count) {
  for (int i = 0; i < count; ++i) backlog.arrived();
}

}  // namespace

TEST_CASE("up to the allowed number wait and all are worked on", "[pipeline][backlog]") {
  Backlog backlog(2);
  for (int round = 0; round < 5; ++round) {
    arrive(backlog, 2);
    CHECK(begin(backlog, 2) == "oo");
  }
}

TEST_CASE("when more wait, all but the newest are passed over", "[pipeline][backlog]") {
  Backlog backlog(2);
  arrive(backlog, 5);
  CHECK(begin(backlog, 5) == "xxxxo");
  arrive(backlog, 2);
  CHECK(begin(backlog, 2) == "oo");
}

TEST_CASE("what arrives while skipping is skipped too, up to the newest", "[pipeline][backlog]") {
  Backlog backlog(2);
  arrive(backlog, 3);
  CHECK(begin(backlog, 2) == "xx");
  arrive(backlog, 1);
  CHECK(begin(backlog, 2) == "xo");
}

TEST_CASE("a sweep that is begun before it is complete does not count as waiting", "[pipeline][backlog]") {
  Backlog backlog(1);
  for (int round = 0; round < 5; ++round) {
    CHECK(begin(backlog, 1) == "o");
    arrive(backlog, 1);
  }
  arrive(backlog, 1);
  CHECK(begin(backlog, 1) == "o");
  arrive(backlog, 2);
  CHECK(begin(backlog, 2) == "xo");
}

TEST_CASE("a replay passes over none", "[pipeline][backlog]") {
  Backlog backlog(0);
  arrive(backlog, 100);
  CHECK(begin(backlog, 100) == std::string(100, 'o'));
}

TEST_CASE("a replay repeats what was recorded", "[pipeline][backlog]") {
  const std::vector<std::uint64_t> recorded{3, 4, 9};
  Backlog backlog(0, Recorded(recorded));
  std::vector<std::uint64_t> passed_over;
  for (const std::uint64_t sequence : {0U, 1U, 3U, 4U, 5U, 8U, 10U})
    if (backlog.passes_over(sequence)) passed_over.push_back(sequence);
  CHECK(passed_over == std::vector<std::uint64_t>{3, 4});
}
