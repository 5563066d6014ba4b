// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/report/profile.hpp"

#include <algorithm>
#include <cmath>

#include "page/markup.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago;
using namespace pago::report;
using namespace pago::test;
using Catch::Matchers::Contains;

constexpr std::int64_t kMs = 1'000'000;

/// Ground takes 2 ms of CPU and 3 of wall time, and `extra_ns` more in sweeps that `is_slow` names; poses
/// come after 20 ms, in each tenth sweep after 120.
template <typename IsSlow>
TimedRun timed_run_of(const std::string& name, int sweeps, std::int64_t extra_ns, const IsSlow& is_slow) {
  TimedRun run{name, {}};
  run.files.facts.source = "drive.pcap";
  run.files.facts.is_live = true;
  run.files.facts.sweeps = {{"posed", 90}, {"dropped: superseded", 3}};
  for (int i = 0; i < sweeps; ++i) {
    output::LatencyRow row;
    row.sequence = static_cast<std::uint64_t>(i);
    output::StageSplit& ground = row.stages[static_cast<std::size_t>(StageId::kGround)];
    ground = {
        .ran = true, .wait_ns = kMs, .run_ns = 3 * kMs, .cpu_ns = 2 * kMs + (is_slow(i) ? extra_ns : 0)};
    row.first_pose_ns = row.refined_pose_ns = (i % 10 == 9 ? 120 : 20) * kMs;
    run.files.latency.push_back(row);
  }
  return run;
}

TimedRun timed_run_of(const std::string& name, int sweeps = 100) {
  return timed_run_of(name, sweeps, 0, [](int) { return false; });
}

const ProfileChange& find(const std::vector<ProfileChange>& all, const std::string& name, TimeKind kind) {
  return *std::find_if(all.begin(), all.end(),
                       [&](const ProfileChange& c) { return c.name == name && c.kind == kind; });
}

TEST_CASE("each kind of time that a run has is a row, a replay has no waits and no time to poses",
          "[report][profile]") {
  TimedRun run = timed_run_of("a");
  const auto has = [&](TimeKind kind) {
    const auto rows = profile_rows(run.files);
    return std::any_of(rows.begin(), rows.end(), [&](const ProfileRow& r) { return r.kind == kind; });
  };
  CHECK(profile_rows(run.files).size() == 3 + 1 + 2);
  CHECK((has(TimeKind::kWait) && has(TimeKind::kRun) && has(TimeKind::kCpu) && has(TimeKind::kPose)));
  run.files.facts.is_live = false;
  CHECK(profile_rows(run.files).size() == 2 + 1);
  CHECK_FALSE((has(TimeKind::kWait) || has(TimeKind::kPose)));
  CHECK(deadline_misses(run.files, 1.0).of == 0);
}

TEST_CASE("a pose that is late or missing is a miss of its deadline", "[report][profile]") {
  TimedRun run = timed_run_of("a");
  CHECK(deadline_misses(run.files, 100.0).late == 10);
  CHECK(deadline_misses(run.files, 120.0).late == 0);
  CHECK(deadline_misses(run.files, 19.0).late == 100);
  run.files.latency[0].refined_pose_ns = -1;
  CHECK(deadline_misses(run.files, 120.0).late == 1);
  CHECK(deadline_misses(run.files, 120.0).of == 100);
  run.files.latency[0].first_pose_ns = -1;  // a part of a rotation, or dropped
  CHECK(deadline_misses(run.files, 120.0).late == 0);
  CHECK(deadline_misses(run.files, 120.0).of == 99);
}

TEST_CASE("runs are compared sweep by sweep, by number", "[report][profile]") {
  const TimedRun before = timed_run_of("a");
  TimedRun after = timed_run_of("b", 110, kMs / 10, [](int i) { return i % 4 != 0; });
  after.files.latency.erase(after.files.latency.begin(), after.files.latency.begin() + 20);
  const ProfileChange c = find(profile_changes(before.files, after.files), "ground", TimeKind::kCpu);
  CHECK(c.num_pairs == 80);
  CHECK(c.slower_share == Approx(0.75 + 0.25 * 0.5));  // a tie counts half
  CHECK(c.p50_ratio() == Approx(2.1 / 2.0));
  CHECK(c.is_significant());
  CHECK(find(profile_changes(before.files, after.files), "ground", TimeKind::kRun).slower_share == 0.5);
}

TEST_CASE("what chance can do is not called a difference", "[report][profile]") {
  const TimedRun before = timed_run_of("a");
  const auto share = [&](int in_100) {
    TimedRun after = timed_run_of("b", 100, 1, [&](int i) { return i < in_100; });
    // The rest is as much faster, so that there are no ties.
    for (int i = in_100; i < 100; ++i)
      after.files.latency[static_cast<std::size_t>(i)]
          .stages[static_cast<std::size_t>(StageId::kGround)]
          .cpu_ns -= 1;
    return find(profile_changes(before.files, after.files), "ground", TimeKind::kCpu);
  };
  CHECK_FALSE(share(50).is_significant());
  CHECK_FALSE(share(66).is_significant());  // 3.2 sigma
  CHECK(share(67).is_significant());
  CHECK(share(33).is_significant());
  CHECK(share(67).slower_share == Approx(0.67));
}

TEST_CASE("runs of other sweeps have no pairs, and are compared all the same", "[report][profile]") {
  const TimedRun before = timed_run_of("a");
  TimedRun after = timed_run_of("b");
  for (output::LatencyRow& row : after.files.latency) row.sequence += 1000;
  const ProfileChange c = find(profile_changes(before.files, after.files), "ground", TimeKind::kCpu);
  CHECK(c.num_pairs == 0);
  CHECK(std::isnan(c.slower_share));
  CHECK_FALSE(c.is_significant());
  CHECK_THAT(profile_comparison_text(before, after, 100.0),
             Contains("ground        cpu") && Contains(" -\n"));
}

TEST_CASE("the terminal says what was lost, late, and how long each stage took", "[report][profile]") {
  const std::string text = profile_text(timed_run_of("results/1"), 100.0);
  CHECK_THAT(text,
             Contains("run       results/1 of drive.pcap\n") &&
                 Contains("sweeps    100, dropped 3 (3 superseded); refined pose later than 100 ms, or none: "
                          "10 of 100\n") &&
                 Contains("  ground        wait      1.00     1.00     1.00     1.00     1.00      100\n") &&
                 Contains("  refined pose  wall     20.00    20.00   120.00   120.00   120.00      100\n"));
  TimedRun replay = timed_run_of("a");
  replay.files.facts.is_live = false;
  CHECK_THAT(profile_text(replay, 100.0), Contains("a replay") && !Contains("wall"));
}

TEST_CASE("the page of one run and of two is whole, and fetches nothing", "[report][profile]") {
  const TimedRun a = timed_run_of("a"), b = timed_run_of("b", 100, kMs, [](int) { return true; });
  for (const ProfilePage& page : {ProfilePage{{a}, 100.0, "made"}, ProfilePage{{a, b}, 100.0, "made"}}) {
    const std::string html = profile_page(page);
    CHECK(misplaced_tag(html) == "");
    CHECK_FALSE(fetches(html));
    CHECK_THAT(html, Contains("The costliest sweeps") && Contains("ground, cpu"));
    CHECK((html.find("Stage by stage") != std::string::npos) == (page.runs.size() == 2));
  }
  CHECK_THAT(profile_page({{a, b}, 100.0, "made"}), Contains("+50.0 %"));
  CHECK_THAT(profile_page({{a}, 100.0, "made"}), Contains("10 had no refined pose within 100 ms"));
}

}  // namespace
