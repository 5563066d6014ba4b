// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/counters.hpp"

#include <set>
#include <string>

#include "pago/core/error.hpp"
#include "pago/core/estimate.hpp"
#include "pago/core/sources.hpp"
#include "support/catch.hpp"

namespace {

/// Every value has a word of its own, so that no two lines of a report read the same.
template <typename Enum>
void require_distinct_words(int count) {
  std::set<std::string> words;
  for (int i = 0; i < count; ++i) words.insert(std::string(to_string(static_cast<Enum>(i))));
  CHECK(words.size() == static_cast<std::size_t>(count));
}

}  // namespace

TEST_CASE("an event counted under any one fate keeps the packet balance", "[core][counters]") {
  pago::PacketCounters counters;
  CHECK(counters.balanced());
  const auto require_one_fate = [&](std::uint64_t& fate) {
    ++counters.received;
    CHECK_FALSE(counters.balanced());
    ++fate;
    CHECK(counters.balanced());
  };
  require_one_fate(counters.decoded);
  require_one_fate(counters.duplicate);
  require_one_fate(counters.late);
  require_one_fate(counters.pending);
  for (auto& fault : counters.bad) require_one_fate(fault);
  CHECK(counters.bad_total() == counters.bad.size());
  ++counters.reordered;  // a property of decoded packets, not a fate
  CHECK(counters.balanced());
}

TEST_CASE("a firing is decoded or lost", "[core][counters]") {
  pago::FiringCounters counters{.expected = 10, .decoded = 7, .lost = 3};
  CHECK(counters.balanced());
  ++counters.decoded;
  CHECK_FALSE(counters.balanced());
}

TEST_CASE("a sweep counted under any one fate keeps the sweep balance", "[core][counters]") {
  pago::SweepCounters counters;
  const auto require_one_fate = [&](std::uint64_t& fate) {
    ++counters.opened;
    CHECK_FALSE(counters.balanced());
    ++fate;
    CHECK(counters.balanced());
  };
  require_one_fate(counters.posed);
  require_one_fate(counters.partial);
  require_one_fate(counters.in_flight);
  for (auto& cause : counters.dropped) require_one_fate(cause);
  CHECK(counters.dropped_total() == counters.dropped.size());
}

TEST_CASE("a record counted under any one fate keeps the source balance", "[core][counters]") {
  pago::SourceCounters counters;
  for (auto* fate : {&counters.delivered, &counters.filtered, &counters.truncated, &counters.fragment_lost,
                     &counters.malformed}) {
    ++counters.received;
    CHECK_FALSE(counters.balanced());
    ++*fate;
    CHECK(counters.balanced());
  }
  CHECK(counters.bad() == 3);
}

TEST_CASE("every fault, drop, health and reason has its own word", "[core][counters]") {
  require_distinct_words<pago::PacketFault>(static_cast<int>(pago::PacketFault::kCount));
  require_distinct_words<pago::SweepDrop>(static_cast<int>(pago::SweepDrop::kCount));
  require_distinct_words<pago::HealthReason>(static_cast<int>(pago::HealthReason::kCount));
  require_distinct_words<pago::Health>(4);
  CHECK(to_string(pago::Health::kLost) == "LOST");
  CHECK(to_string(pago::HealthReason::kIncompleteSweep) == "incomplete sweep");
  CHECK(to_string(pago::PacketFault::kStamp) == "stamp");
  CHECK(to_string(pago::SweepDrop::kSuperseded) == "superseded");
}

TEST_CASE("an error reads as one line: where, what, what to do", "[core][error]") {
  const pago::Error full("db.xml:12", "laser 64 does not exist", "lasers are 0 ... 63");
  CHECK(std::string(full.what()) == "db.xml:12: laser 64 does not exist (lasers are 0 ... 63)");
  CHECK(full.where() == "db.xml:12");
  CHECK(full.problem() == "laser 64 does not exist");
  CHECK(full.hint() == "lasers are 0 ... 63");
  CHECK(std::string(pago::Error("drive.pcap", "no such file").what()) == "drive.pcap: no such file");
}
