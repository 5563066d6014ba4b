// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/pipeline.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <vector>

#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/street_packets.hpp"

using namespace pago;

namespace {

struct RunCollector final : Observer {
  void on_sweep(const output::SweepRecord& record) override {
    records.push_back(record);
    if (records.size() == throw_at) throw std::runtime_error("disk on fire");
    if (records.size() == stop_at) stop = true;
  }
  void on_mount(const ground::MountReport& report) override { mounts.push_back(report); }
  std::vector<output::SweepRecord> records;
  std::vector<ground::MountReport> mounts;
  std::size_t throw_at = 0, stop_at = 0;
  std::atomic<bool> stop{false};
};

Config small_config() {
  Config config;
  config.assembly.ring_size = 3;
  config.hdl64.max_range_m = 120.0;
  return config;
}

RunSummary drive(const Config& config, RunCollector& collector, std::size_t batch = 64) {
  test::MemorySource source(test::street_drive(), batch);
  Pipeline pipeline(config);
  return pipeline.run(source, test::ideal_calibration(), collector, collector.stop);
}

bool same_poses(const RunCollector& a, const RunCollector& b) {
  if (a.records.size() != b.records.size()) return false;
  for (std::size_t i = 0; i < a.records.size(); ++i) {
    if (a.records[i].stamp_ns != b.records[i].stamp_ns ||
        std::memcmp(&a.records[i].T_odom_sensor_refined, &b.records[i].T_odom_sensor_refined,
                    sizeof(output::PoseRow)) != 0) {
      return false;
    }
  }
  return true;
}

/// Empty compensated scans, as many as asked for.
class ScanSource final : public SweepSource {
 public:
  explicit ScanSource(int count, std::string complaint = {}, int partial = -1)
      : count_(count), partial_(partial), complaint_(std::move(complaint)) {}
  bool fill(Sweep& sweep) noexcept override {
    if (next_ == count_) return false;
    sweep.header.sequence = static_cast<std::uint64_t>(next_);
    sweep.header.start_ns = next_ * std::int64_t{100'000'000};
    sweep.header.end_ns = sweep.header.start_ns + 100'000'000;
    sweep.header.flags = kCompensated | (next_ == partial_ ? kPartialEnd : 0U);
    ++next_;
    return true;
  }
  Progress progress() const noexcept override {
    return {static_cast<double>(next_), static_cast<double>(count_)};
  }
  std::string complaint() const override { return complaint_; }

 private:
  int next_ = 0, count_, partial_;
  std::string complaint_;
};

}  // namespace

TEST_CASE("keyframes reach the observer in order, ahead of their records, and only if a map is wanted",
          "[pipeline]") {
  struct MapCollector final : Observer {
    void on_sweep(const output::SweepRecord& record) override { newest = record.header.sequence; }
    void on_map_sweep(const output::MapSweep& sweep) override {
      CHECK(sweep.sequence > newest);
      CHECK(sweep.size > 1000);
      keyframes.push_back(sweep.sequence);
    }
    std::uint64_t newest = 0;
    std::vector<std::uint64_t> keyframes;
    std::atomic<bool> stop{false};
  };
  Vector6d twist = Vector6d::Zero();
  twist[0] = 8.0;
  const std::vector<test::PacketBytes> packets = test::drive_packets(twist, 10);
  for (const bool is_wanted : {true, false}) {
    Config config = small_config();
    config.output.map.save = is_wanted;
    MapCollector collector;
    test::MemorySource source(packets, 64);
    Pipeline pipeline(config);
    const RunSummary summary = pipeline.run(source, test::ideal_calibration(), collector, collector.stop);
    CHECK(summary.unmapped == 0);
    CHECK(std::is_sorted(collector.keyframes.begin(), collector.keyframes.end()));
    CHECK(collector.keyframes.empty() != is_wanted);
  }
}

TEST_CASE("packets of a drive come out as its trajectory", "[pipeline]") {
  RunCollector collector;
  const RunSummary summary = drive(small_config(), collector);
  REQUIRE(summary.failure.empty());
  REQUIRE_FALSE(summary.interrupted);
  REQUIRE(summary.balanced());
  REQUIRE(summary.packets.decoded == test::street_drive().size());
  REQUIRE(summary.sweeps.posed == 5);
  REQUIRE(summary.sweeps.dropped_total() == 0);
  REQUIRE(summary.sweeps.in_flight == 0);
  REQUIRE(summary.threads.size() == 3);

  // From the end of the first sweep to that of the fifth: four tenths of a second.
  std::size_t poses = 0;
  Eigen::Isometry3d T_last = Eigen::Isometry3d::Identity();
  for (const auto& record : collector.records) {
    REQUIRE(record.header.sequence == static_cast<std::uint64_t>(&record - collector.records.data()));
    if (!record.has_pose) continue;
    ++poses;
    T_last = output::to_isometry(record.T_odom_sensor_refined);
  }
  Vector6d travelled = Vector6d::Zero();
  travelled[0] = 8.0 * 0.4, travelled[5] = 0.1 * 0.4;
  REQUIRE(poses == 5);
  REQUIRE((T_last.translation() - exp_se3(travelled).translation()).norm() < 0.12);
  REQUIRE(log_se3(T_last)[5] == Approx(0.04).margin(0.01));
}

TEST_CASE("the verdict on the mount is told once, and stands in the summary", "[pipeline]") {
  Config config = small_config();
  config.ground.mount_check.sweeps = 2;
  config.mount.height_m = 2.4;
  RunCollector collector;
  const RunSummary summary = drive(config, collector);
  CHECK(summary.mount.finding == ground::MountFinding::kWrongHeight);
  CHECK(summary.mount.height_m == Approx(1.73).margin(0.05));
  REQUIRE(collector.mounts.size() == 1);
  CHECK(collector.mounts[0].finding == summary.mount.finding);
  CHECK(collector.mounts[0].height_m == summary.mount.height_m);
}

TEST_CASE("every stage says how long it took on each sweep, in order", "[pipeline]") {
  RunCollector collector;
  drive(small_config(), collector);
  for (const auto& record : collector.records) {
    std::int64_t before_ns = 0;
    for (const StageId stage : {StageId::kIngest, StageId::kGround, StageId::kFeatures, StageId::kOdometry,
                                StageId::kMapping, StageId::kUpdate}) {
      const StageTime& time = record.time_of(stage);
      REQUIRE(time.start_ns > 0);
      REQUIRE(time.end_ns >= time.start_ns);
      REQUIRE(time.end_ns >= before_ns);
      before_ns = time.end_ns;
    }
    REQUIRE(record.header.closed_ns == record.time_of(StageId::kIngest).end_ns);
  }
}

TEST_CASE("ring size, batch size and sectors leave the bytes alone", "[pipeline]") {
  RunCollector reference;
  drive(small_config(), reference);
  struct Case {
    int ring_size;
    std::size_t batch;
    int sectors;
  };
  for (const auto& [ring_size, batch, sectors] : {Case{2, 1, 8}, {6, 500, 1}, {2, 500, 8}}) {
    Config config = small_config();
    config.assembly.ring_size = ring_size;
    config.assembly.sectors = sectors;
    RunCollector collector;
    drive(config, collector, batch);
    INFO("ring " << ring_size << ", batch " << batch << ", sectors " << sectors);
    REQUIRE(same_poses(reference, collector));
  }
}

TEST_CASE("asked to stop, the pipeline works off what it has begun and ends", "[pipeline]") {
  RunCollector collector;
  collector.stop_at = 2;
  const RunSummary summary = drive(small_config(), collector, 8);
  REQUIRE(summary.balanced());
  REQUIRE(collector.records.size() >= 2);
  REQUIRE(summary.sweeps.opened == collector.records.size() + summary.sweeps.dropped_total());
}

TEST_CASE("an observer that throws ends the run and its exception comes out", "[pipeline]") {
  RunCollector collector;
  collector.throw_at = 1;
  REQUIRE_THROWS_WITH(drive(small_config(), collector), "disk on fire");
  REQUIRE(collector.records.size() == 1);
}

TEST_CASE("scans of a folder get a pose each", "[pipeline]") {
  ScanSource source(7);
  RunCollector collector;
  Pipeline pipeline(small_config());
  const RunSummary summary = pipeline.run(source, collector, collector.stop);
  REQUIRE(summary.failure.empty());
  REQUIRE(summary.balanced());
  REQUIRE(summary.sweeps.posed == 7);
  REQUIRE(collector.records.size() == 7);
}

TEST_CASE("a last scan cut short is counted as partial, not as lost", "[pipeline]") {
  ScanSource source(5, {}, 4);
  RunCollector collector;
  Pipeline pipeline(small_config());
  const RunSummary summary = pipeline.run(source, collector, collector.stop);
  REQUIRE(summary.balanced());
  REQUIRE(summary.sweeps.posed == 4);
  REQUIRE(summary.sweeps.partial == 1);
}

TEST_CASE("a pipeline runs once", "[pipeline]") {
  ScanSource source(1);
  RunCollector collector;
  Pipeline pipeline(small_config());
  pipeline.run(source, collector, collector.stop);
  REQUIRE_THROWS_AS(pipeline.run(source, collector, collector.stop), Error);
}

TEST_CASE("a source that breaks off fails the run after what it gave", "[pipeline]") {
  ScanSource source(2, "scan 2 is damaged");
  RunCollector collector;
  Pipeline pipeline(small_config());
  const RunSummary summary = pipeline.run(source, collector, collector.stop);
  REQUIRE(summary.failure == "scan 2 is damaged");
  REQUIRE(collector.records.size() == 2);
}

TEST_CASE("a stream of another sensor is refused by name and yields nothing", "[pipeline]") {
  std::vector<test::PacketBytes> packets;
  for (int i = 0; i < 100; ++i) {
    test::PacketBuilder builder;
    for (int block = 0; block < hdl64::kBlocks; ++block)
      builder.flag(block, hdl64::kUpperBlock).block_azimuth_cdeg(block, (i * 240 + block * 20) % 36000);
    builder.stamp_us(static_cast<std::uint32_t>(1000 + i * 1327)).status(0x37, 0x22);
    packets.push_back(builder.bytes());
  }
  test::MemorySource source(packets);
  RunCollector collector;
  Pipeline pipeline(small_config());
  const RunSummary summary = pipeline.run(source, test::ideal_calibration(), collector, collector.stop);
  REQUIRE(summary.failure.find("VLP-16") != std::string::npos);
  REQUIRE(collector.records.empty());
  REQUIRE(summary.packets.balanced());
}

TEST_CASE("an unknown ground method is refused before anything starts", "[pipeline]") {
  Config config = small_config();
  config.ground.method = "lawn";
  REQUIRE_THROWS_AS(Pipeline(config), Error);
}
