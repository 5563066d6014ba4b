// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/stream_format.hpp"

#include "support/catch.hpp"
#include "support/packet_stream.hpp"

using namespace pago;
using namespace pago::hdl64;
using pago::test::PacketBuilder;

TEST_CASE("the firing period is the nearer of 48.0 and 57.6 us, whatever the model",
          "[hdl64][stream_format]") {
  CHECK(format_of(SensorKind::kHdl64Single, 288'004).firing_period_ns == 48'000);
  CHECK(format_of(SensorKind::kHdl64Single, 345'600).firing_period_ns == 57'600);
  CHECK(format_of(SensorKind::kHdl64Dual, 173'000).firing_period_ns == 57'600);
  CHECK(format_of(SensorKind::kHdl64Dual, 144'000).firing_period_ns == 48'000);
  CHECK(format_of(SensorKind::kHdl64Single, 0).firing_period_ns == 48'000);
  CHECK(format_of(SensorKind::kHdl64Dual, 0).firing_period_ns == 57'600);
  CHECK(format_of(SensorKind::kHdl64EarlyS2, 400'000).firing_period_ns == 48'000);  // by arrival: no measure
}

TEST_CASE("packets hold six, three or nine firings", "[hdl64][stream_format]") {
  CHECK(test::single_return().firings() == 6);
  CHECK(test::early_s2().firings() == 6);
  CHECK(test::dual_return().firings() == 3);
  CHECK(test::s1().firings() == 9);
  CHECK(test::single_return().packet_period_ns() == 288'000);
  CHECK(test::dual_return().packet_period_ns() == 172'800);
  CHECK(test::s1().packet_period_ns() == Approx(1e9 / 2600.0).margin(10));
}

TEST_CASE("every block belongs to exactly one firing, upper ones to upper", "[hdl64][stream_format]") {
  const auto check = [](const StreamFormat& format, int first_lower) {
    const test::PacketStream stream({.format = format, .first_lower_block = first_lower});
    const test::PacketBytes bytes = stream.packet(0);
    const PacketView packet{bytes};
    const PacketLayout& layout = format.layout(packet);
    REQUIRE(layout.firings == format.firings());
    std::array<int, kBlocks> used{};
    const auto use = [&](int block, std::uint16_t flag) {
      if (block < 0) return;
      ++used[static_cast<std::size_t>(block)];
      CHECK(packet.block_flag(block) == flag);
    };
    for (int firing = 0; firing < layout.firings; ++firing) {
      const FiringBlocks& blocks = layout.blocks[static_cast<std::size_t>(firing)];
      CHECK(blocks.upper >= 0);
      use(blocks.upper, kUpperBlock), use(blocks.lower, kLowerBlock);
      use(blocks.second_upper, kUpperBlock), use(blocks.second_lower, kLowerBlock);
    }
    for (const int count : used) CHECK(count == 1);
  };
  check(test::single_return(), 3);
  check(test::dual_return(), 3);
  for (int first_lower = 0; first_lower < 4; ++first_lower) check(test::s1(), first_lower);
}

TEST_CASE("an S1's lower block goes with the upper one before it", "[hdl64][stream_format]") {
  for (int first_lower = 0; first_lower < 4; ++first_lower) {
    const test::PacketBytes bytes =
        test::PacketStream({.format = test::s1(), .first_lower_block = first_lower}).packet(0);
    const PacketLayout& layout = test::s1().layout(PacketView{bytes});
    int lower = 0;
    for (const FiringBlocks& blocks : layout.blocks) {
      if (blocks.lower < 0) continue;
      CHECK(blocks.lower - blocks.upper == (first_lower == 0 ? -1 : 1));
      ++lower;
    }
    CHECK(lower == 3);
  }
}

TEST_CASE("blocks of a firing fire at once, firings one period after another", "[hdl64][stream_format]") {
  const BlockTimes single = test::single_return().block_times_ns();
  const BlockTimes dual = test::dual_return().block_times_ns();
  for (std::size_t block = 0; block < kBlocks; ++block) {
    CHECK(single[block] == static_cast<int>(block / 2) * 48'000);
    CHECK(dual[block] == static_cast<int>(block / 4) * 57'600);
  }
  CHECK(test::s1().block_times_ns()[11] == Approx(11.0 / 12.0 * 1e9 / 2600.0).margin(10));
}

TEST_CASE("lasers fire in groups of four every eighth of a period, both blocks together",
          "[hdl64][stream_format]") {
  const std::array<int, 5> of_48{0, 1260, 2460, 3660, 6000}, of_57{0, 1300, 2500, 3700, 7200};
  for (int laser = 0; laser < 5; ++laser) {
    CHECK(laser_time_ns(laser) == of_48[static_cast<std::size_t>(laser)]);
    CHECK(laser_time_ns(laser, 57'600) == of_57[static_cast<std::size_t>(laser)]);
  }
  CHECK(laser_time_ns(31) == 45'660);
  CHECK(laser_time_ns(31, 57'600) == 54'100);
  const auto times = laser_times_ns(test::dual_return());
  for (std::size_t laser = 0; laser < 32; ++laser) CHECK(times[laser] == times[laser + 32]);
  for (const std::int32_t time : laser_times_ns(test::s1())) CHECK(time == 0);
}

TEST_CASE("each format takes its own packets and no others", "[hdl64][stream_format]") {
  for (int first_lower = 0; first_lower < 4; ++first_lower) {
    const test::PacketStream stream({.format = test::s1(), .first_lower_block = first_lower});
    CHECK(check_packet(stream.packet(3), test::s1()) == PacketFault::kNone);
    CHECK(check_packet(stream.packet(3), test::single_return()) == PacketFault::kBlockFlag);
  }
  const test::PacketStream dual({.format = test::dual_return()});
  CHECK(check_packet(dual.packet(3), test::dual_return()) == PacketFault::kNone);
  CHECK(check_packet(dual.packet(3), test::s1()) == PacketFault::kBlockFlag);
  CHECK(check_packet(std::vector<std::uint8_t>(1205), test::s1()) == PacketFault::kSize);
}

TEST_CASE("one wrong flag or azimuth spoils an S1's packet", "[hdl64][stream_format]") {
  PacketBuilder good;
  for (int block = 0; block < kBlocks; ++block)
    good.flag(block, block % 4 == 3 ? kLowerBlock : kUpperBlock).block_azimuth_cdeg(block, 9 * block);
  CHECK(check_packet(good.bytes(), test::s1()) == PacketFault::kNone);
  for (int block = 0; block < kBlocks; ++block) {
    const std::uint16_t other = block % 4 == 3 ? kUpperBlock : kLowerBlock;
    CHECK(check_packet(PacketBuilder(good).flag(block, other).bytes(), test::s1()) ==
          PacketFault::kBlockFlag);
    CHECK(check_packet(PacketBuilder(good).block_azimuth_cdeg(block, 36000).bytes(), test::s1()) ==
          PacketFault::kAzimuth);
  }
}
