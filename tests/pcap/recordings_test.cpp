// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "pago/pcap/pcap_source.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;

namespace {

/// The decoder's acceptance test in four lines, written from the manual's layout as an independent oracle.
bool is_well_formed(std::span<const std::uint8_t> p) {
  if (p.size() != 1206) return false;
  for (std::size_t block = 0; block < 12; ++block) {
    const std::uint8_t* const b = p.data() + block * 100;
    if (b[0] != 0xFF || b[1] != (block % 2 == 0 ? 0xEE : 0xDD)) return false;
    if (b[2] + 256 * b[3] >= 36000) return false;
  }
  return true;
}

struct Tally {
  SourceCounters counters;
  std::uint64_t valid = 0;  // well-formed, each device stamp once
  bool has_complaint = false;
  bool stamps_rise = true;
};

Tally read(const std::filesystem::path& file, const PacketFilterConfig& filter = {}) {
  PcapSource source(file, filter);
  Tally tally;
  std::set<std::string> stamps;
  std::int64_t last_ns = 0;
  while (!source.all_done())
    for (const Datagram& d : source.receive()) {
      tally.stamps_rise = tally.stamps_rise && d.arrival_ns >= last_ns;
      last_ns = d.arrival_ns;
      if (is_well_formed(d.payload))
        tally.valid += stamps.emplace(d.payload.begin() + 1200, d.payload.begin() + 1204).second ? 1U : 0U;
    }
  tally.counters = source.counters();
  tally.has_complaint = !source.complaint().empty();
  return tally;
}

}  // namespace

TEST_CASE("every variant gives its expected packets", "[pcap][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/variants");
  std::ifstream expect(folder / "EXPECT.tsv");
  std::string line;
  std::getline(expect, line);
  int files = 0;
  for (; std::getline(expect, line); ++files) {
    std::istringstream fields(line);
    std::string name;
    std::uint64_t records = 0, valid = 0;
    fields >> name >> records >> valid;
    INFO(name);
    const Tally tally = read(folder / name, {2368, "192.168.3.43"});
    CHECK(tally.valid == valid);
    CHECK(tally.counters.received == (name == "fragments.pcap" ? records / 2 : records));
    CHECK(tally.counters.balanced());
    CHECK(tally.has_complaint == (name == "cut_record.pcap"));
    CHECK(tally.stamps_rise);
    const std::uint64_t truncated = name == "cut_record.pcap" ? 1 : name == "snaplen600.pcap" ? 720 : 0;
    CHECK(tally.counters.truncated == truncated);
    CHECK(tally.counters.malformed + tally.counters.fragment_lost == 0);
    CHECK(tally.counters.filtered == (name == "multisensor.pcap" ? 1440 : 0));
  }
  CHECK(files == 22);
}

TEST_CASE("real captures of several sensors are read whole", "[pcap][recordings]") {
  PAGO_DATA_OR_SKIP(folder, "packets/captures");
  const auto hdl32 = read(folder / "monterey-first-100-packets.pcap").counters;
  CHECK(hdl32.delivered == 2702);
  CHECK(hdl32.filtered == 299);  // position packets to port 8308
  const auto vlp16 = read(folder / "vlp-16-test-90deg-1-50-frames.pcap").counters;
  CHECK(vlp16.delivered == 1902);
  CHECK(vlp16.filtered == 367);
  const Tally cut = read(folder / "scanparser-vlp16.pcap");  // 41 data, 36 position, 1 ARP, half a position
  CHECK(cut.counters.received == 79);
  CHECK(cut.counters.delivered == 41);
  CHECK(cut.counters.filtered == 37);
  CHECK(cut.counters.truncated == 1);
  CHECK(cut.has_complaint);
  const auto hdl64 = read(folder / "hdl64e_s2_manual_packet.pcap");
  CHECK(hdl64.counters.received == 1);
  CHECK(hdl64.valid == 1);
}

TEST_CASE("a whole drive comes through without loss", "[pcap][recordings]") {
  PAGO_DATA_OR_SKIP(file, "packets/drive_0005/drive_0005.pcap");
  const Tally tally = read(file);
  CHECK(tally.counters.received == 55043);
  CHECK(tally.counters.delivered == 55043);
  CHECK(tally.valid == 55043);
  CHECK(tally.stamps_rise);
}
