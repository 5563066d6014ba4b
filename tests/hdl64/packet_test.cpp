// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/packet.hpp"

#include <vector>

#include "pago/hdl64/stream_format.hpp"
#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/packet_builder.hpp"

using namespace pago;
using namespace pago::hdl64;
using pago::test::PacketBuilder;

TEST_CASE("a well-formed single-return packet passes", "[hdl64][packet]") {
  CHECK(check_packet(PacketBuilder().azimuths_cdeg(35950, 18).fill(4000).bytes()) == PacketFault::kNone);
}

TEST_CASE("a datagram of any other size is refused", "[hdl64][packet]") {
  for (const std::size_t size : {0U, 1U, 200U, 512U, 1205U, 1207U, 1248U})
    CHECK(check_packet(std::vector<std::uint8_t>(size)) == PacketFault::kSize);
}

TEST_CASE("one wrong block flag anywhere spoils the packet", "[hdl64][packet]") {
  for (int block = 0; block < kBlocks; ++block) {
    const std::uint16_t other = block % 2 == 0 ? kLowerBlock : kUpperBlock;
    CHECK(check_packet(PacketBuilder().flag(block, other).bytes()) == PacketFault::kBlockFlag);
    CHECK(check_packet(PacketBuilder().flag(block, 0xCCFF).bytes()) == PacketFault::kBlockFlag);
    CHECK(check_packet(PacketBuilder().flag(block, 0).bytes()) == PacketFault::kBlockFlag);
  }
}

TEST_CASE("azimuths end at 359.99 degrees", "[hdl64][packet]") {
  for (int firing = 0; firing < kFirings; ++firing) {
    CHECK(check_packet(PacketBuilder().azimuth_cdeg(firing, 35999).bytes()) == PacketFault::kNone);
    CHECK(check_packet(PacketBuilder().azimuth_cdeg(firing, 36000).bytes()) == PacketFault::kAzimuth);
    CHECK(check_packet(PacketBuilder().azimuth_cdeg(firing, 65535).bytes()) == PacketFault::kAzimuth);
  }
}

TEST_CASE("the two blocks of a firing must agree on the azimuth", "[hdl64][packet]") {
  for (int block = 0; block < kBlocks; ++block)
    CHECK(check_packet(PacketBuilder().block_azimuth_cdeg(block, 9).bytes()) == PacketFault::kAzimuth);
}

TEST_CASE("the view reads each field from its place on the wire", "[hdl64][packet]") {
  test::PacketBytes bytes = PacketBuilder().bytes();
  bytes[502] = 0x34;  // block 5 = lower block of firing 2; the pair's azimuth is read from block 4
  bytes[402] = 0x34;
  bytes[403] = bytes[503] = 0x12;
  bytes[400 + 4 + 3 * 7] = 0xCD;  // firing 2, laser 7: distance 0xABCD, intensity 0xEF
  bytes[400 + 5 + 3 * 7] = 0xAB;
  bytes[400 + 6 + 3 * 7] = 0xEF;
  bytes[1100 + 4 + 3 * 31] = 0x01;  // firing 5, laser 63
  bytes[1100 + 6 + 3 * 31] = 0x77;
  bytes[1200] = 0x04;
  bytes[1203] = 0x80;
  bytes[1204] = 'V';
  bytes[1205] = 0x47;
  const PacketView view{bytes};
  CHECK(view.azimuth_cdeg(2) == 0x1234);
  CHECK(view.distance_raw(2, 7) == 0xABCD);
  CHECK(view.intensity(2, 7) == 0xEF);
  CHECK(view.distance_raw(5, 63) == 1);
  CHECK(view.intensity(5, 63) == 0x77);
  CHECK(view.distance_raw(0, 0) == 0);
  CHECK(view.stamp_us() == 0x80000004U);
  CHECK(view.status_type() == 'V');
  CHECK(view.status_value() == 0x47);
}

TEST_CASE("damaged packets of a capture are found, and no others", "[hdl64][packet]") {
  PAGO_DATA_OR_SKIP(folder, "packets/variants");
  const auto faults_in = [&folder = folder](const char* name) {
    std::array<int, static_cast<std::size_t>(PacketFault::kCount)> count{};
    for (const auto& packet : test::read_capture(folder / name))
      ++count[static_cast<std::size_t>(check_packet(packet.payload))];
    return count;
  };
  using Count = std::array<int, static_cast<std::size_t>(PacketFault::kCount)>;
  CHECK(faults_in("base.pcap") == Count{720, 0, 0, 0, 0});
  // Every 50th has a wrong flag, every 50th an azimuth of 400 degrees (EXPECT.tsv: 691 valid).
  CHECK(faults_in("corrupt.pcap") == Count{691, 0, 15, 14, 0});
}
