// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <chrono>
#include <cstring>
#include <functional>
#include <thread>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "support/catch.hpp"
#include "support/street_packets.hpp"

using namespace pago;

namespace {

struct Collector final : Observer {
  void on_sweep(const output::SweepRecord& record) override {
    records.push_back(record);
    if (records.size() == reset_at) on_reset();
    ++num_through;
    std::this_thread::sleep_for(delay);
  }
  void on_pose(const output::PoseV1& pose) override { poses.push_back(pose); }
  void on_status(const IngestStatus& now) override { status = now; }

  std::vector<output::SweepRecord> records;
  std::vector<output::PoseV1> poses;
  IngestStatus status;
  std::chrono::milliseconds delay{0};
  std::size_t reset_at = 0;
  std::function<void()> on_reset;
  std::atomic<std::uint64_t> num_through{0};
  std::atomic<bool> stop{false};
};

/// Hands packets on only when at most one sweep is under way: a sensor that is never too fast.
class PatientSource final : public PacketSource {
 public:
  PatientSource(const std::vector<test::PacketBytes>& packets, const std::atomic<std::uint64_t>& num_through)
      : source_(packets, kBatch), num_through_(num_through) {}

  std::span<const Datagram> receive() noexcept override {
    constexpr std::uint64_t kPerSweep = 348;
    while (given_ / kPerSweep > num_through_ + 1) std::this_thread::yield();
    given_ += kBatch;
    return source_.receive();
  }
  bool all_done() const noexcept override { return source_.all_done(); }
  SourceCounters counters() const noexcept override { return source_.counters(); }
  Progress progress() const noexcept override { return {}; }
  std::string complaint() const override { return {}; }

 private:
  static constexpr std::uint64_t kBatch = 32;
  test::MemorySource source_;
  const std::atomic<std::uint64_t>& num_through_;
  std::uint64_t given_ = 0;
};

Config live_config() {
  Config config;
  config.assembly.ring_size = 4;
  config.publish.shared_memory.clear();
  for (ThreadConfig* thread : {&config.pipeline.ingest, &config.pipeline.front, &config.pipeline.estimate})
    *thread = {};
  return config;
}

}  // namespace

TEST_CASE("a live run that keeps up gives the bytes of a replay, and each pose twice", "[pipeline][live]") {
  Collector live, replay;
  PatientSource patient(test::street_drive(), live.num_through);
  const RunSummary summary =
      Pipeline(live_config(), Pace::kLive).run(patient, test::ideal_calibration(), live, live.stop);
  test::MemorySource memory(test::street_drive());
  Pipeline(live_config()).run(memory, test::ideal_calibration(), replay, replay.stop);

  REQUIRE(summary.balanced());
  REQUIRE(summary.sweeps.dropped_total() == 0);
  REQUIRE(summary.unrecorded == 0);
  REQUIRE(live.records.size() == replay.records.size());
  for (std::size_t i = 0; i < live.records.size(); ++i) {
    CHECK(live.records[i].stamp_ns == replay.records[i].stamp_ns);
    CHECK(std::memcmp(&live.records[i].T_odom_sensor_refined, &replay.records[i].T_odom_sensor_refined,
                      sizeof(output::PoseRow)) == 0);
  }
  // When the stream ends in a sweep the last pose is told again, as lost.
  REQUIRE(live.poses.size() == 2 * (summary.sweeps.posed + 1));
  for (int i = 0; i < 2; ++i) {
    CHECK(live.poses.back().health == PAGO_HEALTH_LOST);
    CHECK(live.poses.back().sequence == live.poses[live.poses.size() - 3].sequence);
    live.poses.pop_back();
  }
  CHECK(replay.poses.empty());
  for (std::size_t i = 0; i < live.poses.size(); ++i) {
    CHECK(live.poses[i].kind == (i % 2 == 0 ? PAGO_POSE_FIRST : PAGO_POSE_REFINED));
    CHECK(live.poses[i].sequence == live.records[i / 2].header.sequence);
    CHECK(live.poses[i].published_ns > 0);
  }
  CHECK(live.status.packets.decoded == test::street_drive().size());
  CHECK(stream_state(live.status, live.status.last_delivery_ns) == StreamState::kRunning);
}

TEST_CASE("a source faster than the pipeline costs whole sweeps, each counted by its cause",
          "[pipeline][live]") {
  Collector collector;
  test::MemorySource source(test::street_drive());
  Config config = live_config();
  config.assembly.ring_size = 2;
  config.pipeline.max_pending = 1;
  const RunSummary summary =
      Pipeline(config, Pace::kLive).run(source, test::ideal_calibration(), collector, collector.stop);
  INFO("no free sweep " << summary.sweeps.dropped[0] << ", superseded " << summary.sweeps.dropped[1]);
  REQUIRE(summary.balanced());
  CHECK(summary.sweeps.dropped_total() > 0);
  CHECK(summary.packets.decoded == test::street_drive().size());
  std::uint64_t posed = 0, superseded = 0;
  for (const auto& record : collector.records) {
    posed += record.has_pose ? 1U : 0U;
    superseded += record.header.has(kSuperseded) && !record.header.has(kPartialEnd) ? 1U : 0U;
    CHECK_FALSE((record.has_pose && record.header.has(kSuperseded)));
  }
  CHECK(posed == summary.sweeps.posed);
  CHECK(superseded == summary.sweeps.dropped[static_cast<std::size_t>(SweepDrop::kSuperseded)]);
}

TEST_CASE("a live run that dropped sweeps is repeated to the last bit when told what it dropped",
          "[pipeline][live]") {
  Collector live, replay;
  output::DecisionLog log;
  Config config = live_config();
  config.assembly.ring_size = 2;
  config.pipeline.max_pending = 1;
  config.assembly.sectors = GENERATE(1, 4);
  test::MemorySource source(test::street_drive());
  Pipeline overloaded(config, Pace::kLive);
  live.reset_at = 2;
  live.on_reset = [&] { overloaded.request_reset(); };
  const RunSummary summary = overloaded.run(source, test::ideal_calibration(), live, live.stop);
  REQUIRE(summary.sweeps.dropped_total() > 0);
  for (const auto& record : live.records) log.add(record);
  log.close(summary.requests);

  test::MemorySource again(test::street_drive());
  Pipeline(config, Pace::kReplay, log.decisions()).run(again, test::ideal_calibration(), replay, replay.stop);
  REQUIRE(replay.records.size() == live.records.size());
  for (std::size_t i = 0; i < live.records.size(); ++i) {
    const auto &a = live.records[i], &b = replay.records[i];
    CHECK(a.header.sequence == b.header.sequence);
    CHECK(a.header.flags == b.header.flags);
    CHECK(a.has_pose == b.has_pose);
    CHECK(std::memcmp(&a.T_odom_sensor_refined, &b.T_odom_sensor_refined, sizeof(output::PoseRow)) == 0);
  }
}

TEST_CASE("live, a sensor that cannot be read does not end the run", "[pipeline][live]") {
  std::vector<test::PacketBytes> packets;
  for (int i = 0; i < 400; ++i) {
    test::PacketBuilder builder;
    for (int block = 0; block < hdl64::kBlocks; ++block)
      builder.flag(block, hdl64::kUpperBlock).block_azimuth_cdeg(block, (i * 240 + block * 20) % 36000);
    builder.stamp_us(static_cast<std::uint32_t>(1000 + i * 1327)).status(0x37, 0x22);
    packets.push_back(builder.bytes());
  }
  Collector collector;
  test::MemorySource source(packets);
  const RunSummary summary =
      Pipeline(live_config(), Pace::kLive).run(source, test::ideal_calibration(), collector, collector.stop);
  CHECK(summary.packets.received == 400);
  CHECK(summary.packets.bad_total() == 400);
  CHECK(summary.balanced());
  CHECK_FALSE(summary.interrupted);
}

TEST_CASE("scans are not received live", "[pipeline][live]") {
  struct None final : SweepSource {
    bool fill(Sweep&) noexcept override { return false; }
    Progress progress() const noexcept override { return {}; }
    std::string complaint() const override { return {}; }
  } none;
  Collector collector;
  CHECK_THROWS_AS(Pipeline(live_config(), Pace::kLive).run(none, collector, collector.stop), Error);
}
