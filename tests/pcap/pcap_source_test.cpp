// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/pcap_source.hpp"

#include <algorithm>
#include <fstream>

#include "frames.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/new_counter.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr std::int64_t kStampNs = 1'700'000'000'123'456'789;

/// A datagram that outlives its source's buffer.
struct Kept {
  Octets payload;
  Datagram datagram;
};

std::vector<Kept> read_all(PcapSource& source) {
  std::vector<Kept> out;
  while (!source.all_done())
    for (const Datagram& d : source.receive()) out.push_back({{d.payload.begin(), d.payload.end()}, d});
  REQUIRE(source.counters().balanced());
  REQUIRE(source.counters().delivered == out.size());
  return out;
}

SourceCounters count_all(const std::filesystem::path& file, const PacketFilterConfig& filter = {}) {
  PcapSource source(file, filter);
  read_all(source);
  return source.counters();
}

/// The message with which opening fails.
std::string refusal(const std::filesystem::path& file, const PacketFilterConfig& filter = {}) {
  try {
    PcapSource source(file, filter);
  } catch (const Error& error) {
    return error.what();
  }
  return "no refusal";
}

}  // namespace

TEST_CASE("datagrams come out as they were written", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const auto stamps =
      GENERATE(test::PcapWriter::Stamps::kMicroseconds, test::PcapWriter::Stamps::kNanoseconds);
  {
    test::PcapWriter writer(file.path(), stamps);
    for (std::size_t i = 0; i < 200; ++i)
      writer.write_udp(counting_payload(i * 10, static_cast<std::uint8_t>(i)),
                       kStampNs + static_cast<std::int64_t>(i) * 288'000);
  }
  PcapSource source(file.path());
  const std::vector<Kept> got = read_all(source);
  REQUIRE(got.size() == 200);
  for (std::size_t i = 0; i < got.size(); ++i) {
    const Datagram& d = got[i].datagram;
    REQUIRE(got[i].payload == counting_payload(i * 10, static_cast<std::uint8_t>(i)));
    const std::int64_t written_ns = kStampNs + static_cast<std::int64_t>(i) * 288'000;
    REQUIRE(d.arrival_ns ==
            (stamps == test::PcapWriter::Stamps::kNanoseconds ? written_ns : written_ns / 1000 * 1000));
    REQUIRE(d.source_ipv4 == 0xC0A8032B);
    REQUIRE(d.source_port == 443);
    REQUIRE(d.destination_port == 2368);
  }
  CHECK(source.complaint().empty());
  CHECK(source.progress().done == source.progress().total);
  CHECK(source.progress().total == static_cast<double>(std::filesystem::file_size(file.path())));
  CHECK(source.receive().empty());
}

TEST_CASE("a batch holds at most 64 datagrams", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  {
    test::PcapWriter writer(file.path());
    for (int i = 0; i < 128; ++i) writer.write_udp(counting_payload(1206), kStampNs);
  }
  PcapSource source(file.path());
  CHECK(source.receive().size() == 64);
  CHECK(source.receive().size() == 64);
  CHECK_FALSE(source.all_done());
  CHECK(source.receive().empty());
  CHECK(source.all_done());
}

TEST_CASE("a capture of other traffic gives empty batches, not a long silence", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  {
    test::PcapWriter writer(file.path());
    for (int i = 0; i < 5000; ++i) writer.write_udp(counting_payload(10), kStampNs, {.destination_port = 53});
  }
  PcapSource source(file.path());
  CHECK(source.receive().empty());
  CHECK_FALSE(source.all_done());
  CHECK(source.receive().empty());
  CHECK(source.all_done());
  CHECK(source.counters().filtered == 5000);
}

TEST_CASE("port and sender choose one sensor of several", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  {
    test::PcapWriter writer(file.path());
    const Octets payload = counting_payload(1206);
    writer.write_udp(payload, kStampNs);
    writer.write_udp(payload, kStampNs, {.source_ipv4 = 0xC0A8032C});
    writer.write_udp(payload, kStampNs, {.destination_port = 2369});
    writer.write(ethernet(ipv6(udp(payload)), 0x86DD), kStampNs);
    writer.write(ethernet(Octets(46, 0), 0x0806), kStampNs);
  }
  const auto delivered = [&](int port, const char* sender) {
    const SourceCounters counters = count_all(file.path(), {port, sender});
    CHECK(counters.received == 5);
    return counters.delivered;
  };
  CHECK(delivered(2368, "") == 3);
  CHECK(delivered(2368, "192.168.3.43") == 1);
  CHECK(delivered(0, "192.168.3.43") == 2);
  CHECK(delivered(2369, "") == 1);
  CHECK(delivered(0, "") == 4);
  CHECK(delivered(2370, "") == 0);
}

TEST_CASE("every bad record is counted by its reason", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const Octets payload = counting_payload(1206);
  const Octets datagram = udp(payload);
  const OctetView head = OctetView(datagram).first(1000), tail = OctetView(datagram).subspan(1000);
  {
    test::PcapWriter writer(file.path());
    const Octets frame = udp_frame(payload);
    writer.write(OctetView(frame).first(600), kStampNs, frame.size());  // truncated
    writer.write(OctetView(frame).first(10), kStampNs, frame.size());   // truncated before any header
    writer.write(OctetView(frame).first(600), kStampNs);                // malformed: claims to be whole
    const Octets other = udp_frame(payload, {.destination_port = 8308});
    writer.write(OctetView(other).first(600), kStampNs, other.size());  // filtered, though truncated
    writer.write_udp(counting_payload(2049), kStampNs);                 // truncated: too long to keep
    writer.write_udp(counting_payload(2048), kStampNs);                 // delivered
    writer.write(ethernet(ipv4(tail, {}, {.id = 1, .offset = 1000})), kStampNs);
    writer.write(ethernet(ipv4(head, {}, {.id = 1, .more = true})), kStampNs);           // delivered
    writer.write(ethernet(ipv4(head, {}, {.id = 2, .more = true})), kStampNs);           // lost
    writer.write(ethernet(ipv4(head, {}, {.id = 3, .more = true}, {}, 6)), kStampNs);    // filtered
    writer.write(ethernet(ipv4(tail, {}, {.id = 3, .offset = 1000}, {}, 6)), kStampNs);  // the same
    const Octets cut = ethernet(ipv4(head, {}, {.id = 4, .more = true}));
    writer.write(OctetView(cut).first(600), kStampNs, cut.size());
    writer.write(ethernet(ipv4(tail, {}, {.id = 4, .offset = 1000})), kStampNs);  // truncated
    writer.write(OctetView(cut).first(600), kStampNs);                            // malformed
    const Octets to_8308 = udp(payload, {.destination_port = 8308});
    writer.write(ethernet(ipv4(OctetView(to_8308).first(800), {}, {.id = 5, .more = true})), kStampNs);
    writer.write(ethernet(ipv4(OctetView(to_8308).subspan(800), {}, {.id = 5, .offset = 800})),
                 kStampNs);  // filtered
  }
  const SourceCounters counters = count_all(file.path());
  CHECK(counters.delivered == 2);
  CHECK(counters.truncated == 4);
  CHECK(counters.malformed == 2);
  CHECK(counters.filtered == 3);
  CHECK(counters.fragment_lost == 1);
  CHECK(counters.received == 12);
}

TEST_CASE("fragments of another sender do not disturb", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const Octets datagram = udp(counting_payload(1206));
  const OctetView head = OctetView(datagram).first(1000), tail = OctetView(datagram).subspan(1000);
  {
    test::PcapWriter writer(file.path());
    const Endpoints other{.source_ipv4 = 0xC0A8032C};
    writer.write(ethernet(ipv4(head, {}, {.id = 1, .more = true})), kStampNs);
    writer.write(ethernet(ipv4(head, other, {.id = 1, .more = true})), kStampNs);
    writer.write(ethernet(ipv4(tail, other, {.id = 1, .offset = 1000})), kStampNs);
    writer.write(ethernet(ipv4(tail, {}, {.id = 1, .offset = 1000})), kStampNs);
  }
  const SourceCounters one = count_all(file.path(), {2368, "192.168.3.43"});
  CHECK(one.delivered == 1);
  CHECK(one.filtered == 1);
  CHECK(count_all(file.path()).delivered == 2);
}

TEST_CASE("a capture cut anywhere gives what came before and says where it ends", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const Octets frame = udp_frame(counting_payload(100));
  const std::size_t record = 16 + frame.size();
  {
    test::PcapWriter writer(file.path());
    for (int i = 0; i < 4; ++i) writer.write(frame, kStampNs);
  }
  for (std::size_t bytes = 24; bytes <= 24 + 4 * record; ++bytes) {
    INFO("cut to " << bytes << " bytes");
    const TemporaryPath cut(".pcap");
    std::filesystem::copy_file(file.path(), cut.path());
    std::filesystem::resize_file(cut.path(), bytes);
    PcapSource source(cut.path());
    const std::size_t whole = (bytes - 24) / record;
    CHECK(read_all(source).size() == whole);
    const bool is_clean = (bytes - 24) % record == 0;
    CHECK(source.counters().truncated == (is_clean ? 0 : 1));
    const std::string at = "ends inside a record at byte " + std::to_string(24 + whole * record);
    const std::string kept = "the " + std::to_string(whole) + " records before it were used";
    CHECK(source.complaint().empty() == is_clean);
    if (!is_clean) {
      CHECK_THAT(source.complaint(), Catch::Contains(cut.path().string()));
      CHECK_THAT(source.complaint(), Catch::Contains(at) && Catch::Contains(kept));
    }
  }
}

TEST_CASE("a damaged record header ends the capture with a complaint", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const Octets frame = udp_frame(counting_payload(100));
  {
    test::PcapWriter writer(file.path());
    for (int i = 0; i < 3; ++i) writer.write(frame, kStampNs);
  }
  {
    std::fstream patch(file.path(), std::ios::in | std::ios::out | std::ios::binary);
    patch.seekp(static_cast<std::streamoff>(24 + 16 + frame.size() + 8));
    patch.write("\xFF\xFF\xFF\x7F", 4);
  }
  PcapSource source(file.path());
  CHECK(read_all(source).size() == 1);
  CHECK_THAT(source.complaint(),
             Catch::Contains("damaged at byte " + std::to_string(24 + 16 + frame.size())));
  CHECK(source.progress().done < source.progress().total);
}

TEST_CASE("what cannot be read is refused with a reason and a hint", "[pcap][source]") {
  using Catch::Contains;
  const TemporaryPath file(".pcap");
  const auto holding = [&](const std::string& bytes) {
    std::ofstream(file.path(), std::ios::binary) << bytes;
    return refusal(file.path());
  };
  CHECK_THAT(refusal("/nowhere/drive.pcap"), Contains("/nowhere/drive.pcap: cannot be opened: No such file"));
  CHECK_THAT(refusal(std::filesystem::temp_directory_path()), Contains("folder") && Contains("kitti:"));
  CHECK_THAT(holding(""), Contains("not a capture") && Contains("empty"));
  CHECK_THAT(holding("this is a text file, not a capture at all"),
             Contains("not a capture") && Contains("pcapng"));
  CHECK_THAT(holding("\x1F\x8B\x08 and so on and so on and so on"), Contains("gunzip"));
  CHECK_THAT(holding("\xD4\xC3\xB2\xA1\x02"), Contains("not a capture"));
  { test::PcapWriter writer(file.path(), test::PcapWriter::Stamps::kNanoseconds, 105); }
  CHECK_THAT(refusal(file.path()), Contains("link layer") && Contains("IEEE802_11"));
}

TEST_CASE("an impossible filter is refused by its key", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  { test::PcapWriter writer(file.path()); }
  CHECK_THAT(refusal(file.path(), {2368, "lidar"}),
             Catch::Contains("packets.source_address") && Catch::Contains("lidar"));
  CHECK_THAT(refusal(file.path(), {2368, "0.0.0.0"}), Catch::Contains("packets.source_address"));
  CHECK_THAT(refusal(file.path(), {70000, ""}), Catch::Contains("packets.port"));
  CHECK(count_all(file.path()).received == 0);
}

TEST_CASE("reading allocates nothing", "[pcap][source]") {
  const TemporaryPath file(".pcap");
  const Octets datagram = udp(counting_payload(1206));
  {
    test::PcapWriter writer(file.path());
    for (std::uint16_t id = 0; id < 500; ++id) {
      writer.write_udp(counting_payload(1206), kStampNs);
      writer.write(ethernet(ipv4(OctetView(datagram).first(1000), {}, {.id = id, .more = true})), kStampNs);
      writer.write(ethernet(ipv4(OctetView(datagram).subspan(1000), {}, {.id = id, .offset = 1000})),
                   kStampNs);
    }
  }
  PcapSource source(file.path());
  std::size_t datagrams = 0;
  const std::uint64_t before = news_so_far();
  while (!source.all_done()) datagrams += source.receive().size();
  CHECK(news_so_far() == before);
  CHECK(datagrams == 1000);
  const Octets planted(1, 0);
  CHECK(news_so_far() > before);
}
