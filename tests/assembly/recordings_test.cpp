// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>
#include <sstream>

#include "assembly/collector.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;

namespace {

struct Replay {
  Replay(const std::filesystem::path& capture,
         const std::filesystem::path& calibration,
         const AssemblyConfig& config = {},
         const PacketFilterConfig& filter = {})
      : ingest(config, {}, hdl64::load_calibration(calibration, VerticalOffset::kVertical), collector),
        source(capture, filter) {}

  void run() {
    for (auto batch = source.receive(); !batch.empty(); batch = source.receive())
      for (const Datagram& datagram : batch) ingest.push(datagram);
    ingest.finish();
    CHECK(source.counters().balanced());
    CHECK(ingest.packets().balanced());
    CHECK(ingest.firings().balanced());
    CHECK(ingest.sweeps().balanced());
  }
  std::size_t whole_sweeps() const {
    std::size_t n = 0;
    for (const auto& sweep : collector.sweeps) n += sweep.header.is_posed() ? 1U : 0U;
    return n;
  }

  test::Collector collector;
  PacketIngest ingest;
  PcapSource source;
};

void check_clean(const Replay& replay, std::uint64_t packets, std::size_t sweeps, double columns) {
  CHECK(replay.ingest.packets().decoded == packets);
  CHECK(replay.ingest.packets().bad_total() == 0);
  CHECK(replay.ingest.firings().lost == 0);
  CHECK(replay.collector.received() == 6 * packets);
  CHECK(replay.whole_sweeps() == sweeps);
  for (std::size_t i = 0; i < sweeps; ++i) {
    const SweepHeader& h = replay.collector.sweeps[i].header;
    REQUIRE(h.sequence == i);
    REQUIRE(h.flags == 0);
    REQUIRE(h.firings_lost == 0);
    REQUIRE(std::abs(h.num_columns - columns) < 1.0);
    if (i > 0) REQUIRE(h.start_ns == replay.collector.sweeps[i - 1].header.end_ns);
  }
}

}  // namespace

TEST_CASE("drive_0005 has 153 whole sweeps and a start of the next", "[assembly][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  Replay replay(folder / "drive_0005.pcap", folder / "calibration.yaml");
  replay.run();
  check_clean(replay, 55'043, 153, 2158.5);
  REQUIRE(replay.collector.sweeps.size() == 154);
  CHECK(replay.collector.sweeps[153].header.has(kPartialEnd));
  CHECK(replay.collector.sweeps[153].header.firings_received < 10);
  for (std::size_t i = 0; i < 153; ++i) CHECK(replay.collector.sweeps[i].size > 100'000);
}

TEST_CASE("the standing capture has 11 whole sweeps", "[assembly][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0057_standing");
  Replay replay(folder / "drive_0057.pcap", folder / "calibration.yaml");
  replay.run();
  check_clean(replay, 3958, 11, 2158.5);
}

TEST_CASE("the lab's worlds have 150 whole sweeps each", "[assembly][recordings]") {
  for (const char* world : {"packets/lab_urban", "packets/lab_rural"}) {
    PAGO_DATA_OR_SKIP(folder, world);
    Replay replay(folder / "packets.pcap", folder / "calibration.xml");
    replay.run();
    INFO(world);
    CHECK(replay.ingest.packets().decoded == 52'079);
    CHECK(replay.ingest.packets().bad_total() == 0);
    CHECK(replay.ingest.firings().lost == 0);
    REQUIRE(replay.collector.sweeps.size() == 150);
    // Rotation i of the truth: start, middle and end in seconds.
    std::ifstream times(folder / "times_start_mid_end.txt");
    for (std::size_t i = 0; i < 150; ++i) {
      const SweepHeader& h = replay.collector.sweeps[i].header;
      REQUIRE(h.flags == 0);
      double start_s = 0, mid_s = 0, end_s = 0;
      REQUIRE(times >> start_s >> mid_s >> end_s);
      // Stamps name the end of the packet here; within half a firing and the table's microseconds.
      REQUIRE(std::abs(static_cast<double>(h.start_ns - 288'000) * 1e-9 - start_s) < 26e-6);
      REQUIRE(h.start_ns == (i == 0 ? h.start_ns : replay.collector.sweeps[i - 1].header.end_ns));
    }
  }
}

TEST_CASE("every container and every fault gives the expected number of packets", "[assembly][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/variants");
  std::ifstream table(folder / "EXPECT.tsv");
  std::string line;
  std::getline(table, line);
  int files = 0;
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string name;
    std::uint64_t records = 0, valid = 0;
    row >> name >> records >> valid;
    INFO(name);
    PacketFilterConfig filter;
    filter.source_address = "192.168.3.43";
    Replay replay(folder / name, folder.parent_path() / "calibration/ros-drivers_64e_s2.1-sztaki.xml", {},
                  filter);
    replay.run();
    CHECK(replay.ingest.packets().decoded == valid);
    CHECK(replay.ingest.is_refused() == (valid == 0));
    ++files;
    if (valid == 0) continue;
    CHECK(replay.collector.received() == 6 * valid);
    CHECK(replay.ingest.packets().pending == 0);
    if (name != "cut_record.pcap") CHECK(replay.ingest.firings().expected == 6 * 720);
    CHECK(replay.collector.lost() == replay.ingest.firings().lost);
    CHECK(replay.ingest.packets().duplicate == (name == "duplicate.pcap" ? 29U : 0U));
    CHECK(replay.ingest.packets().reordered == (name == "reorder.pcap" ? 18U : 0U));
  }
  CHECK(files == 22);
}

TEST_CASE("captures of other sensors, and of too little, are refused", "[assembly][recordings]") {
  struct Case {
    const char *file, *words;
  };
  for (const Case& c :
       {Case{"monterey-first-100-packets.pcap", "HDL-32E"}, Case{"scanparser-vlp16.pcap", "VLP-16"},
        Case{"vlp-16-test-90deg-1-50-frames.pcap", "VLP-16"},
        Case{"hdl64e_s2_manual_packet.pcap", "1 packet"}}) {
    PAGO_DATA_OR_SKIP(folder, "packets/captures");
    Replay replay(folder / c.file, folder.parent_path() / "calibration/ros-drivers_64e_s2.1-sztaki.xml");
    replay.run();
    CHECK(replay.ingest.is_refused());
    CHECK_THAT(replay.ingest.refusal(), Catch::Contains(c.words));
    CHECK(replay.collector.sweeps.empty());
  }
}

TEST_CASE("a recording gives the same bytes in sectors, and again", "[assembly][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0057_standing");
  const auto digests = [&](int sectors) {
    AssemblyConfig config;
    config.sectors = sectors;
    Replay replay(folder / "drive_0057.pcap", folder / "calibration.yaml", config);
    replay.collector.with_digest = true;
    replay.run();
    std::vector<std::uint64_t> all;
    for (const auto& sweep : replay.collector.sweeps) all.push_back(sweep.digest);
    return all;
  };
  const auto whole = digests(1);
  CHECK(whole.size() == 12);
  CHECK(digests(1) == whole);
  CHECK(digests(36) == whole);
}
