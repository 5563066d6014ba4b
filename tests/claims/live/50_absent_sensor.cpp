// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// A live run that is started 2 s before its sensor, whose sensor (the recorded drive over loopback UDP) is
// cut off for 5 s and comes back; and a second run on a port that is taken: what is said, and what becomes of
// the poses.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <optional>
#include <thread>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/paced_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/platform/clock.hpp"
#include "pago/udp/udp_sender.hpp"
#include "pago/udp/udp_source.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;

namespace {

constexpr std::chrono::seconds kHeadStart{2};
constexpr std::int64_t kGapStart_ns = 5'000'000'000, kGapEnd_ns = 10'000'000'000;
constexpr std::uint64_t kMaxSweepsToRecover = 3;

/// The drive without what was recorded in the gap.
class CutOff final : public PacketSource {
 public:
  explicit CutOff(PacketSource& whole) : whole_(whole) {}

  std::span<const Datagram> receive() noexcept override {
    kept_.clear();
    for (const Datagram& datagram : whole_.receive()) {
      if (first_ns_ == 0) first_ns_ = datagram.arrival_ns;
      const std::int64_t since_ns = datagram.arrival_ns - first_ns_;
      if (since_ns < kGapStart_ns || since_ns >= kGapEnd_ns) kept_.push_back(datagram);
    }
    return kept_;
  }
  bool all_done() const noexcept override { return whole_.all_done(); }
  SourceCounters counters() const noexcept override { return whole_.counters(); }
  Progress progress() const noexcept override { return whole_.progress(); }
  std::string complaint() const override { return whole_.complaint(); }

 private:
  PacketSource& whole_;
  std::vector<Datagram> kept_;
  std::int64_t first_ns_ = 0;
};

/// Collects what the run says of its stream and what comes out of it.
class Watcher final : public Observer {
 public:
  void on_sweep(const output::SweepRecord& record) override { records.push_back(record); }
  void on_status(const IngestStatus& status) override {
    const StreamState state = stream_state(status, platform::monotonic_ns());
    if (states.empty() || states.back() != state) {
      states.push_back(state);
      sentences.push_back(explain(state, status, "the port"));
    }
  }
  std::vector<output::SweepRecord> records;
  std::vector<StreamState> states;
  std::vector<std::string> sentences;
};

RunSummary run_live(const Config& config, const hdl64::Calibration& calibration, Watcher& watcher) {
  UdpSource source({"127.0.0.1", 0}, config.packets, config.udp);
  std::atomic<bool> stop{false};
  std::thread sensor([&] {
    std::this_thread::sleep_for(kHeadStart);
    PcapSource whole(claims::recording("packets/drive_0005/drive_0005.pcap"));
    CutOff cut(whole);
    PacedSource paced(cut);
    UdpSender sender({"127.0.0.1", source.port()});
    while (!paced.all_done()) sender.send(paced.receive());
    std::this_thread::sleep_for(std::chrono::seconds(1));
    stop = true;
  });
  const RunSummary summary = Pipeline(config, Pace::kLive).run(source, calibration, watcher, stop);
  sensor.join();
  return summary;
}

RunSummary run_replay(const Config& config, const hdl64::Calibration& calibration, Watcher& watcher) {
  PcapSource whole(claims::recording("packets/drive_0005/drive_0005.pcap"));
  CutOff cut(whole);
  return Pipeline(config).run(cut, calibration, watcher, std::atomic<bool>{false});
}

bool said(const Watcher& watcher, StreamState state, const std::string& word) {
  for (std::size_t i = 0; i < watcher.states.size(); ++i) {
    if (watcher.states[i] == state && watcher.sentences[i].find(word) != std::string::npos) return true;
  }
  return false;
}

/// The states in their order, as far as they were the sensor's and not a moment's.
std::string story(const Watcher& watcher) {
  std::string text;
  for (const StreamState state : watcher.states) {
    if (state == StreamState::kNotSpinning) continue;
    if (!text.empty()) text += ", ";
    text += to_string(state);
  }
  return text;
}

std::uint64_t posed(const Watcher& watcher) {
  return static_cast<std::uint64_t>(std::count_if(watcher.records.begin(), watcher.records.end(),
                                                  [](const auto& r) { return r.has_pose; }));
}

/// Posed sweeps after the gap until one is trusted again; and whether the first of them was trusted, which it
/// must not be: nothing says what the vehicle did for 5 s.
void judge_return(Report& report, const Watcher& watcher) {
  std::uint64_t untrusted = 0;
  std::optional<Health> first;
  std::int64_t last_end_ns = 0;
  for (const auto& record : watcher.records) {
    if (!record.has_pose) continue;
    const bool is_return = last_end_ns != 0 && record.header.start_ns - last_end_ns > 4'000'000'000;
    if (is_return) first = record.health;
    if (first && record.health == Health::kOk) break;
    if (first) ++untrusted;
    last_end_ns = record.header.end_ns;
  }
  report.exactly("sensor gone for 5 s: first pose after it is trusted", first == Health::kOk ? 1 : 0, 0);
  report.at_most("sensor gone for 5 s: poses after it until one is trusted",
                 first ? static_cast<double>(untrusted) : 1e9, kMaxSweepsToRecover, "");
}

/// A run's stamps count from the hour in which its packets came, so those of two runs differ by whole hours.
bool same_poses(const Watcher& a, const Watcher& b) {
  const auto same = [&](const output::SweepRecord& x, const output::SweepRecord& y) {
    return x.has_pose == y.has_pose &&
           x.header.start_ns - a.records[0].header.start_ns ==
               y.header.start_ns - b.records[0].header.start_ns &&
           x.T_odom_sensor_first == y.T_odom_sensor_first &&
           x.T_odom_sensor_refined == y.T_odom_sensor_refined;
  };
  return a.records.size() == b.records.size() &&
         std::equal(a.records.begin(), a.records.end(), b.records.begin(), same);
}

void measure(Report& report) {
  Config config;
  config.publish.shared_memory.clear();
  config.hdl64.calibration = claims::recording("packets/drive_0005/calibration.yaml").string();
  const auto calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  Watcher live, replay;
  const RunSummary summary = run_live(config, calibration, live);

  const std::string expected = "no data, running, silent, running, silent";
  report.shown("states", story(live));
  report.exactly("states other than: " + expected, story(live) == expected ? 0 : 1, 0);
  report.exactly("before the sensor: the cause is named (cable, address, firewall)",
                 said(live, StreamState::kNoData, "firewall") ? 1 : 0, 1);
  report.exactly("sensor gone: the cause is named (power, cable, switch)",
                 said(live, StreamState::kSilent, "cable") ? 1 : 0, 1);
  report.exactly("identities that do not hold", summary.balanced() ? 0 : 1, 0);
  report.exactly("sweeps dropped", summary.sweeps.dropped_total(), 0);
  judge_return(report, live);

  run_replay(config, calibration, replay);
  report.exactly("poses, of those in a replay of the same packets", posed(live), posed(replay));
  report.exactly("the replay's poses, bit for bit", same_poses(live, replay) ? 1 : 0, 1);

  const UdpSource taken({"127.0.0.1", 0});
  std::string refusal;
  try {
    const UdpSource second({"127.0.0.1", taken.port()});
  } catch (const Error& error) {
    refusal = error.what();
  }
  report.shown("a port that is taken", refusal.empty() ? "not refused" : "refused");
  report.exactly("a port that is taken: the cause is named",
                 refusal.find("another program has the port") != std::string::npos ? 1 : 0, 1);
}

}  // namespace

int main() {
  return claims::run("absent sensor", measure);
}
