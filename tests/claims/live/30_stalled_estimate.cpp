// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The recorded drive, live, with the estimate thread put to sleep every 5 s: for 200 ms, which the queue can
// hold, and for 600 ms, which it cannot: what is dropped is counted by cause, and who drives on the poses
// never has an old one.
#include <algorithm>
#include <atomic>
#include <memory>
#include <thread>
#include <vector>

#include "pago/output/latency.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/paced_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "tests/claims/live/stalls.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;

namespace {

constexpr double kMaxPoseAge_s = 0.5;
constexpr std::uint64_t kMaxSweepsToRecover = 3;
constexpr std::int64_t kShort_ns = 200'000'000, kLong_ns = 600'000'000, kEvery_ns = 5'000'000'000;
constexpr int kMinStalls = 2;
/// A sweep whose pose comes later than this after its last packet waits behind a stall.
constexpr std::int64_t kLate_ns = 100'000'000;

/// The age of the newest pose, as whoever drives on it sees it: now minus the instant of its sweep's last
/// packet.
struct Watcher final : Observer {
  void on_sweep(const output::SweepRecord& record) override { records.push_back(record); }
  void on_pose(const output::PoseV1& pose) override {
    if (pose.kind != PAGO_POSE_REFINED) return;
    // The first poses come late for another reason: the first motion has to be found.
    constexpr std::uint64_t kStart_sweeps = 10;
    if (pose.sequence > kStart_sweeps && last_arrival_ns > 0)
      worst_age_ns = std::max(worst_age_ns, pose.published_ns - last_arrival_ns);
    last_arrival_ns = pose.last_arrival_ns;
  }
  std::vector<output::SweepRecord> records;
  std::int64_t last_arrival_ns = 0, worst_age_ns = 0;
};

/// The longest run of sweeps that were late or dropped.
std::uint64_t longest_disturbance(const std::vector<output::SweepRecord>& records) {
  std::uint64_t longest = 0, current = 0, last_sequence = 0;
  for (const auto& record : records) {
    if (record.header.sequence < 10) continue;
    const bool has_gap = last_sequence != 0 && record.header.sequence > last_sequence + 1;
    const bool is_late = !record.has_pose || output::first_pose_ns(record) > kLate_ns;
    current = is_late || has_gap ? current + 1 : 0;
    longest = std::max(longest, current);
    last_sequence = record.header.sequence;
  }
  return longest;
}

struct Outcome {
  RunSummary summary;
  Watcher watcher;
};

std::unique_ptr<Outcome> run_with_stalls(std::int64_t length_ns) {
  const auto drive = claims::recording("packets/drive_0005");
  Config config;
  config.publish.shared_memory.clear();
  config.hdl64.calibration = (drive / "calibration.yaml").string();
  const auto calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  claims::stall = {.thread = "estimate", .length_ns = length_ns, .every_ns = kEvery_ns};
  claims::num_stalls = 0;
  PcapSource recorded(drive / "drive_0005.pcap");
  PacedSource source(recorded);
  auto outcome = std::make_unique<Outcome>();
  outcome->summary =
      Pipeline(config, Pace::kLive).run(source, calibration, outcome->watcher, std::atomic<bool>{false});
  return outcome;
}

std::uint64_t superseded(const std::vector<output::SweepRecord>& records) {
  return static_cast<std::uint64_t>(std::ranges::count_if(
      records, [](const output::SweepRecord& record) { return record.header.has(kSuperseded); }));
}

void judge_counts(Report& report, const std::string& text, const Outcome& outcome) {
  const SweepCounters& sweeps = outcome.summary.sweeps;
  report.at_least(text + "stalls planted", claims::num_stalls, kMinStalls, "");
  report.shown(text + "sweeps dropped", std::to_string(sweeps.dropped[0]) + " no free sweep, " +
                                            std::to_string(sweeps.dropped[1]) + " superseded");
  report.exactly(text + "identities that do not hold", outcome.summary.balanced() ? 0 : 1, 0);
  report.exactly(text + "sweeps posed + partial + dropped, of those opened",
                 sweeps.posed + sweeps.partial + sweeps.dropped_total(), sweeps.opened);
  report.exactly(text + "sweeps superseded, of the records that say so", sweeps.dropped[1],
                 superseded(outcome.watcher.records));
}

void measure(Report& report) {
  const auto brief = run_with_stalls(kShort_ns);
  std::string text = "stall of 200 ms: ";
  judge_counts(report, text, *brief);
  report.at_most(text + "oldest newest pose", static_cast<double>(brief->watcher.worst_age_ns) * 1e-9,
                 kMaxPoseAge_s, " s");
  report.at_most(text + "sweeps in a row late or dropped",
                 static_cast<double>(longest_disturbance(brief->watcher.records)), kMaxSweepsToRecover, "");

  const auto lengthy = run_with_stalls(kLong_ns);
  text = "stall of 600 ms: ";
  judge_counts(report, text, *lengthy);
  report.at_least(text + "sweeps superseded", static_cast<double>(lengthy->summary.sweeps.dropped[1]), 1, "");
}

}  // namespace

int main() {
  return claims::run("stalled estimate", measure);
}
