// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/sweep_reader.hpp"

#include <vector>

#include "pago/pipeline/pipeline.hpp"
#include "support/catch.hpp"
#include "support/street_packets.hpp"

using namespace pago;

namespace {

const std::vector<test::PacketBytes>& three_sweeps() {
  static const std::vector<test::PacketBytes> packets = test::drive_packets(Vector6d::Zero(), 3);
  return packets;
}

struct RecordKeeper final : Observer {
  void on_sweep(const output::SweepRecord& record) override { records.push_back(record); }
  std::vector<output::SweepRecord> records;
};

/// Calls everything a road.
class RoadSource final : public PacketSource {
 public:
  explicit RoadSource(const std::vector<test::PacketBytes>& packets) : packets_(packets) {}
  std::span<const Datagram> receive() noexcept override { return packets_.receive(); }
  bool all_done() const noexcept override { return packets_.all_done(); }
  SourceCounters counters() const noexcept override { return packets_.counters(); }
  Progress progress() const noexcept override { return packets_.progress(); }
  std::string complaint() const override { return {}; }
  bool has_labels() const noexcept override { return true; }
  void label(Sweep& sweep) const noexcept override {
    std::fill_n(sweep.label.data(), sweep.size, std::uint16_t{40});
    sweep.header.flags |= kLabelled;
  }

 private:
  test::MemorySource packets_;
};

/// Two scans of a return each, and then a fault.
class TwoScans final : public SweepSource {
 public:
  bool fill(Sweep& sweep) noexcept override {
    if (next_ == 2) return false;
    sweep.size = 1;
    sweep.header.sequence = next_++;
    return true;
  }
  Progress progress() const noexcept override { return {}; }
  std::string complaint() const override { return next_ == 2 ? "the third is damaged" : ""; }

 private:
  std::uint64_t next_ = 0;
};

}  // namespace

TEST_CASE("a reader gives the sweeps that a replay makes, the parts at the ends too",
          "[pipeline][sweep_reader]") {
  test::MemorySource replayed(three_sweeps()), read(three_sweeps());
  RecordKeeper replay;
  const std::atomic<bool> stop{false};
  Pipeline(Config{}).run(replayed, test::ideal_calibration(), replay, stop);

  SweepReader reader(Config{}, read, test::ideal_calibration());
  std::size_t i = 0;
  for (const Sweep* sweep = nullptr; (sweep = reader.next()) != nullptr; ++i) {
    REQUIRE(i < replay.records.size());
    CHECK(sweep->header.sequence == replay.records[i].header.sequence);
    CHECK(sweep->header.start_ns == replay.records[i].header.start_ns);
    CHECK(sweep->header.flags == replay.records[i].header.flags);
    CHECK(sweep->size == replay.records[i].num_returns);
    CHECK_FALSE(sweep->header.has(kLabelled));
  }
  CHECK(i == replay.records.size());
  CHECK(i >= 3);
  CHECK(reader.next() == nullptr);
  CHECK(reader.failure().empty());
}

TEST_CASE("what a source knows of its packets labels the reader's sweeps, and the pipeline's",
          "[pipeline][sweep_reader]") {
  RoadSource read(three_sweeps()), replayed(three_sweeps());
  SweepReader reader(Config{}, read, test::ideal_calibration());
  Sweep* const sweep = reader.next();
  REQUIRE(sweep != nullptr);
  CHECK(sweep->header.has(kLabelled));
  CHECK(sweep->label[sweep->size - 1] == 40);

  Config config;
  config.ground.method = "truth";
  RecordKeeper replay;
  const std::atomic<bool> stop{false};
  Pipeline(config).run(replayed, test::ideal_calibration(), replay, stop);
  REQUIRE(replay.records.size() >= 3);
  for (const output::SweepRecord& record : replay.records) CHECK(record.num_ground == record.num_returns);
}

TEST_CASE("scans come one by one, and a fault is told", "[pipeline][sweep_reader]") {
  TwoScans source;
  SweepReader reader(Config{}, source);
  for (std::uint64_t i = 0; i < 2; ++i) {
    const Sweep* const sweep = reader.next();
    REQUIRE(sweep != nullptr);
    CHECK(sweep->header.sequence == i);
  }
  CHECK(reader.next() == nullptr);
  CHECK(reader.failure() == "the third is damaged");
}

TEST_CASE("another sensor's packets give no sweep and a reason", "[pipeline][sweep_reader]") {
  std::vector<test::PacketBytes> packets;
  for (int i = 0; i < 100; ++i) {  // a VLP-16's: strongest return
    test::PacketBuilder builder;
    for (int block = 0; block < hdl64::kBlocks; ++block)
      builder.flag(block, hdl64::kUpperBlock).block_azimuth_cdeg(block, (i * 240 + block * 20) % 36000);
    builder.stamp_us(static_cast<std::uint32_t>(1000 + i * 1327)).status(0x37, 0x22);
    packets.push_back(builder.bytes());
  }
  test::MemorySource source(packets);
  SweepReader reader(Config{}, source, test::ideal_calibration());
  CHECK(reader.next() == nullptr);
  CHECK(reader.failure().find("VLP-16") != std::string::npos);
}
