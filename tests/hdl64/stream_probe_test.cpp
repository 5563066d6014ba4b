// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/stream_probe.hpp"

#include <fstream>
#include <iterator>
#include <random>
#include <vector>

#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/packet_stream.hpp"

using namespace pago;
using namespace pago::hdl64;
using pago::test::PacketBuilder;

namespace {

/// The decision on the packets from `first` on; kCount if there was none.
SensorKind decide(const std::vector<test::CapturedPacket>& packets, std::size_t first = 0) {
  StreamProbe probe;
  for (std::size_t i = first; i < packets.size() && !probe.decided(); ++i)
    probe.add(packets[i].payload, packets[i].arrival_ns);
  return probe.decided() ? probe.kind() : SensorKind::kCount;
}

/// Checks a recording from many starting points; the decision must not hang on the phase.
void check_recording(const std::filesystem::path& capture, SensorKind expected, std::int64_t period_us) {
  const std::vector<test::CapturedPacket> packets = test::read_capture(capture, 3000);
  REQUIRE(packets.size() >= 41);
  for (std::size_t first = 0; first + 16 <= packets.size(); first += 5) {
    INFO(capture << " from packet " << first);
    REQUIRE(decide(packets, first) == expected);
  }
  StreamProbe probe;
  for (const auto& packet : packets) probe.add(packet.payload, packet.arrival_ns);
  CHECK(std::abs(probe.packet_period_ns() / 1000 - period_us) <= 1);
}

/// A stream made of one packet after another by a rule: `make` gets the packet's number.
template <typename Make>
std::vector<test::CapturedPacket> stream_of(std::size_t size, std::int64_t period_ns, Make make) {
  std::vector<test::CapturedPacket> packets;
  for (std::size_t i = 0; i < size; ++i) {
    const auto time_ns = static_cast<std::int64_t>(i) * period_ns;
    PacketBuilder builder;
    make(builder.stamp_us(static_cast<std::uint32_t>(5'000'000 + time_ns / 1000)), static_cast<int>(i));
    packets.push_back({time_ns, {builder.bytes().begin(), builder.bytes().end()}});
  }
  return packets;
}

/// All blocks 0xEEFF, azimuths stepping every `blocks_per_azimuth` blocks, the model in the last byte.
auto one_bank(int blocks_per_azimuth, std::uint8_t model, int step_cdeg = 20) {
  return [=](PacketBuilder& builder, int i) {
    for (int block = 0; block < kBlocks; ++block)
      builder.flag(block, kUpperBlock)
          .block_azimuth_cdeg(block, (12 * i + block) / blocks_per_azimuth * step_cdeg % 36000);
    builder.status(0x37, model);
  };
}

}  // namespace

TEST_CASE("HDL-64E streams in single-return mode are recognised from any point on", "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(folder, "packets");
  for (const char* name :
       {"drive_0005/drive_0005.pcap", "drive_0057_standing/drive_0057.pcap", "lab_urban/packets.pcap",
        "lab_rural/packets.pcap", "synthetic/synth_S2.pcap", "synthetic/synth_S3.pcap"})
    check_recording(folder / name, SensorKind::kHdl64Single, 288);
}

TEST_CASE("loss, duplicates, reordering and damage do not hide an HDL-64E", "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(folder, "packets/variants");
  for (const char* name :
       {"drop3pct.pcap", "drop_burst.pcap", "duplicate.pcap", "reorder.pcap", "corrupt.pcap"})
    check_recording(folder / name, SensorKind::kHdl64Single, 288);
}

TEST_CASE("dual return is told from single by azimuths and pace", "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(folder, "packets/synthetic");
  check_recording(folder / "synth_S3D.pcap", SensorKind::kHdl64Dual, 173);
}

TEST_CASE("an HDL-32E is recognised", "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(folder, "packets/captures");
  check_recording(folder / "monterey-first-100-packets.pcap", SensorKind::kHdl32, 553);
}

TEST_CASE("a VLP-16 is recognised, though one claims to be an HDL-32E", "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(folder, "packets/captures");
  check_recording(folder / "vlp-16-test-90deg-1-50-frames.pcap", SensorKind::kVlp16, 1327);
  check_recording(folder / "scanparser-vlp16.pcap", SensorKind::kVlp16, 1327);
}

TEST_CASE("the packet printed in the 2008 manual is early, once there are enough of it",
          "[hdl64][stream_probe]") {
  PAGO_DATA_OR_SKIP(file, "packets/captures/hdl64e_s2_manual_packet.bin");
  std::ifstream stream(file, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::vector<std::uint8_t> packet(bytes.begin(), bytes.end());
  REQUIRE(packet.size() == kPacketBytes);
  StreamProbe probe;
  for (int i = 0; i < 15; ++i) {
    probe.add(packet, i * 288'000);
    CHECK_FALSE(probe.decided());
    CHECK(probe.kind() == SensorKind::kUnknown);
  }
  probe.add(packet, 15 * 288'000);
  CHECK(probe.decided());
  CHECK(probe.kind() == SensorKind::kHdl64EarlyS2);
}

TEST_CASE("temperature and version alternate in an early trailer", "[hdl64][stream_probe]") {
  const auto text = [](PacketBuilder& builder, int i) {
    const char* words = i % 2 == 0 ? "DegC" : "V25b";
    builder.stamp_us(static_cast<std::uint32_t>(words[0] << 16 | words[1] << 24))
        .status(words[2], static_cast<std::uint8_t>(words[3]));
  };
  CHECK(decide(stream_of(20, 288'000, text)) == SensorKind::kHdl64EarlyS2);
}

TEST_CASE("a head at rest is not called dual, nor a dual one single", "[hdl64][stream_probe]") {
  const auto at_rest = [](PacketBuilder& builder, int) { builder.azimuths_cdeg(4500, 0); };
  CHECK(decide(stream_of(16, 288'000, at_rest)) == SensorKind::kHdl64Single);
  CHECK(decide(stream_of(16, 345'600, at_rest)) == SensorKind::kHdl64Single);
  CHECK(decide(stream_of(16, 172'800, at_rest)) == SensorKind::kHdl64Dual);
}

TEST_CASE("a slow or starting head is not called dual", "[hdl64][stream_probe]") {
  for (const double rotation_hz : {0.2, 0.5, 1.0, 2.0, 5.0, 20.0}) {
    const test::PacketStream stream({.rotation_hz = rotation_hz});
    for (std::int64_t first = 0; first < 700; first += 3) {
      StreamProbe probe;
      for (std::int64_t i = first; i < first + 16; ++i) probe.add(stream.packet(i), stream.arrival_ns(i));
      REQUIRE(probe.kind() == SensorKind::kHdl64Single);
    }
  }
}

TEST_CASE("without usable stamps azimuths and arrival decide", "[hdl64][stream_probe]") {
  const auto dual = [](PacketBuilder& builder, int i) {
    builder.stamp_us(77);
    for (int firing = 0; firing < kFirings; ++firing)
      builder.azimuth_cdeg(firing, (18 * i + firing / 2 * 9) % 36000);
  };
  CHECK(decide(stream_of(16, 172'800, dual)) == SensorKind::kHdl64Dual);
  CHECK(decide(stream_of(16, 0, dual)) == SensorKind::kHdl64Dual);
  const auto single = [](PacketBuilder& builder, int i) {
    builder.stamp_us(77).azimuths_cdeg(108 * i % 36000, 18);
  };
  CHECK(decide(stream_of(16, 0, single)) == SensorKind::kHdl64Single);
}

TEST_CASE("three upper blocks for each lower one are an S1", "[hdl64][stream_probe]") {
  for (int phase = 0; phase < 4; ++phase) {
    const auto s1 = [phase](PacketBuilder& builder, int) {
      for (int block = 0; block < kBlocks; ++block)
        builder.flag(block, (block + phase) % 4 == 3 ? kLowerBlock : kUpperBlock);
    };
    CHECK(decide(stream_of(16, 384'000, s1)) == SensorKind::kHdl64S1);
  }
}

TEST_CASE("a VLS-128 is recognised by its four banks, wherever they start", "[hdl64][stream_probe]") {
  const std::array<std::uint16_t, 4> banks{kUpperBlock, kLowerBlock, 0xCCFF, 0xBBFF};
  for (std::size_t phase = 0; phase < 4; ++phase) {
    const auto vls = [banks, phase](PacketBuilder& builder, int) {
      for (std::size_t block = 0; block < kBlocks; ++block)
        builder.flag(static_cast<int>(block), banks[(block + phase) % 4]);
      builder.status(0x37, 0xA1);
    };
    CHECK(decide(stream_of(16, 165'000, vls)) == SensorKind::kVls128);
  }
}

TEST_CASE("sensors of one bank are told apart by pace, then by their model byte", "[hdl64][stream_probe]") {
  CHECK(decide(stream_of(16, 663'552, one_bank(1, 0x28))) == SensorKind::kVlp32c);
  CHECK(decide(stream_of(16, 663'552, one_bank(2, 0x22))) == SensorKind::kVlp16);  // dual return
  CHECK(decide(stream_of(16, 331'776, one_bank(2, 0x28))) == SensorKind::kVlp32c);
  CHECK(decide(stream_of(16, 276'480, one_bank(2, 0x21))) == SensorKind::kHdl32);
  CHECK(decide(stream_of(16, 1'327'104, one_bank(1, 0x00))) == SensorKind::kVlp16);
  CHECK(decide(stream_of(16, 663'552, one_bank(1, 0x24, 0))) == SensorKind::kVlp16);  // at rest
  CHECK(decide(stream_of(16, 800'000, one_bank(1, 0x21))) == SensorKind::kHdl32);
  CHECK(decide(stream_of(16, 800'000, one_bank(1, 0x00))) == SensorKind::kOneBank);
}

TEST_CASE("noise and foreign datagrams end as unknown", "[hdl64][stream_probe]") {
  std::mt19937 random(3);
  StreamProbe noise;
  std::vector<std::uint8_t> bytes(kPacketBytes);
  for (int i = 0; i < 64; ++i) {
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    noise.add(bytes, i * 288'000);
  }
  CHECK(noise.decided());
  CHECK(noise.kind() == SensorKind::kUnknown);
  StreamProbe foreign;
  for (int i = 0; i < 256; ++i) foreign.add(std::vector<std::uint8_t>(512), i);
  CHECK(foreign.decided());
  CHECK(foreign.kind() == SensorKind::kUnknown);
}

TEST_CASE("stray and damaged datagrams in between only delay the decision", "[hdl64][stream_probe]") {
  const test::PacketStream stream;
  StreamProbe probe;
  for (std::int64_t i = 0; i < 16; ++i) {
    probe.add(std::vector<std::uint8_t>(200), stream.arrival_ns(i));
    test::PacketBytes bytes = stream.packet(i);
    if (i % 2 == 0) bytes[static_cast<std::size_t>(i) % 12 * 100] = 0;
    probe.add(bytes, stream.arrival_ns(i));
  }
  CHECK_FALSE(probe.decided());  // 8 of 16 are no majority
  probe.add(stream.packet(16), stream.arrival_ns(16));
  CHECK(probe.decided());
  CHECK(probe.kind() == SensorKind::kHdl64Single);
}

TEST_CASE("the pace is measured across the top of the hour", "[hdl64][stream_probe]") {
  const test::PacketStream stream({.stamp_us = kStampWrap_us - 2000});
  StreamProbe probe;
  for (std::int64_t i = 0; i < 16; ++i) probe.add(stream.packet(i), stream.arrival_ns(i));
  CHECK(probe.packet_period_ns() == 288'000);
}

TEST_CASE("a refusal names the sensor and what PaGO reads", "[hdl64][stream_probe]") {
  CHECK(refusal(SensorKind::kVlp16) ==
        "this stream comes from a VLP-16; PaGO reads the HDL-64E (S1, S2, S2.1, S3)");
  CHECK(refusal(SensorKind::kHdl64Single).empty());
  CHECK(name(SensorKind::kHdl32) == "HDL-32E");
  for (int kind = 0; kind < static_cast<int>(SensorKind::kCount); ++kind) {
    const auto value = static_cast<SensorKind>(kind);
    CHECK_FALSE(name(value).empty());
    CHECK(refusal(value).empty() == is_supported(value));
  }
}
