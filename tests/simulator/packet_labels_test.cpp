// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/packet_labels.hpp"

#include <fstream>

#include "pago/core/error.hpp"
#include "pago/hdl64/stream_format.hpp"
#include "pago/simulator/unit.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using namespace pago::simulator;

namespace {

constexpr std::int64_t kFirstPacket_ns = 1'772'446'500'000'000'000;

/// A packet whose slots' classes tell laser and firing apart: firing k, laser l.
SimulatedPacket packet(int number) {
  constexpr std::array<std::uint16_t, 4> kClasses{40, 50, 252, 70};
  SimulatedPacket result;
  result.time_ns = kFirstPacket_ns + number * hdl64::kPacketPeriod_ns;
  for (std::size_t slot = 0; slot < kSlotsPerPacket; ++slot)
    result.labels[slot] = kClasses[(slot + slot / 32 + static_cast<std::size_t>(number)) % 4];
  return result;
}

std::uint16_t expected(int number, int firing, int laser) {
  return packet(number).labels[static_cast<std::size_t>((2 * firing + laser / 32) * 32 + laser % 32)];
}

/// A sweep of every laser in the first firings of some packets; its clock is `shift_ns` off.
void fill(Sweep& sweep, const hdl64::Calibration& unit, int packets, std::int64_t shift_ns) {
  sweep.reset();
  sweep.header.start_ns = kFirstPacket_ns + shift_ns;
  for (int number = 0; number < packets; ++number) {
    for (int firing = 0; firing < 6; ++firing) {
      for (int laser = 0; laser < 64; ++laser) {
        sweep.ring[sweep.size] = unit.ring_of_laser[static_cast<std::size_t>(laser)];
        sweep.time_offset_ns[sweep.size++] = number * 288'000 + firing * 48'000 + hdl64::laser_time_ns(laser);
      }
    }
  }
}

void require_right(const Sweep& sweep, const hdl64::Calibration& unit, int packets) {
  std::uint32_t i = 0;
  for (int number = 0; number < packets; ++number)
    for (int firing = 0; firing < 6; ++firing)
      for (int laser = 0; laser < 64; ++laser, ++i) {
        REQUIRE(sweep.ring[i] == unit.ring_of_laser[static_cast<std::size_t>(laser)]);
        REQUIRE(sweep.label[i] == expected(number, firing, laser));
      }
}

}  // namespace

TEST_CASE("every return finds the class of its slot", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(20, 48'000, 6);
  for (int number = 0; number < 10; ++number) track.add(packet(number));
  Sweep sweep(64 * 6 * 10);
  fill(sweep, unit, 10, 0);
  REQUIRE(track.label(sweep, unit) == sweep.size);
  require_right(sweep, unit, 10);
}

TEST_CASE("a dual-return packet's second returns find their own classes", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(20, 57'600, 3);
  track.add(packet(0));
  Sweep sweep(64 * 3 * 2);
  sweep.header.start_ns = kFirstPacket_ns;
  for (int firing = 0; firing < 3; ++firing) {
    for (const std::uint8_t echo : {std::uint8_t{0}, std::uint8_t{kNotStrongest | kNotLast}}) {
      for (int laser = 0; laser < 64; ++laser) {
        sweep.ring[sweep.size] = unit.ring_of_laser[static_cast<std::size_t>(laser)];
        sweep.echo[sweep.size] = echo;
        sweep.time_offset_ns[sweep.size++] = firing * 57'600 + hdl64::laser_time_ns(laser, 57'600);
      }
    }
  }
  REQUIRE(track.label(sweep, unit) == sweep.size);
  // Returns were added in the order of a dual-return packet's slots: two blocks, and two of second returns.
  for (std::uint32_t i = 0; i < sweep.size; ++i) REQUIRE(sweep.label[i] == packet(0).labels[i]);
}

TEST_CASE("an S3's firings are farther apart, and its returns find their classes, too",
          "[simulator][labels]") {
  constexpr std::int64_t kPeriod_ns = 57'600;
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(20, kPeriod_ns, 6);
  track.add(packet(0));
  Sweep sweep(64 * 6);
  sweep.header.start_ns = kFirstPacket_ns;
  for (int firing = 0; firing < 6; ++firing) {
    for (int laser = 0; laser < 64; ++laser) {
      sweep.ring[sweep.size] = unit.ring_of_laser[static_cast<std::size_t>(laser)];
      sweep.time_offset_ns[sweep.size++] =
          static_cast<std::int32_t>(firing * kPeriod_ns) + hdl64::laser_time_ns(laser, kPeriod_ns);
    }
  }
  REQUIRE(track.label(sweep, unit) == sweep.size);
  for (std::uint32_t i = 0; i < sweep.size; ++i) REQUIRE(sweep.label[i] == packet(0).labels[i]);
}

TEST_CASE("a replay hours later finds them too", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(20, 48'000, 6);
  for (int number = 0; number < 10; ++number) track.add(packet(number));
  Sweep sweep(64 * 6 * 10);
  for (const std::int64_t hours : {1, -3, 5000}) {
    fill(sweep, unit, 10, hours * 3'600'000'000'000);
    REQUIRE(track.label(sweep, unit) == sweep.size);
    require_right(sweep, unit, 10);
  }
}

TEST_CASE("a file of labels gives the same", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  const test::TemporaryPath file(".labels");
  {
    LabelWriter writer(file.path(), 48'000, 6);
    for (int number = 0; number < 10; ++number) writer.write(packet(number));
    writer.flush();
    REQUIRE(writer.complaint().empty());
  }
  const LabelTrack track(file.path());
  REQUIRE(track.size() == 10);
  Sweep sweep(64 * 6 * 10);
  fill(sweep, unit, 10, 0);
  REQUIRE(track.label(sweep, unit) == sweep.size);
  require_right(sweep, unit, 10);
}

TEST_CASE("a full track forgets the oldest, and what it never saw has no class", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(4, 48'000, 6);
  for (int number = 0; number < 10; ++number) track.add(packet(number));
  REQUIRE(track.size() == 4);
  Sweep sweep(64 * 6 * 10);
  fill(sweep, unit, 10, 0);
  CHECK(track.label(sweep, unit) == 4 * 384);
  CHECK(sweep.label[0] == 0);
  CHECK(sweep.label[9 * 384] == expected(9, 0, 0));
}

TEST_CASE("a lost packet leaves its neighbours' labels alone", "[simulator][labels]") {
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack track(20, 48'000, 6);
  for (const int number : {0, 1, 3, 4}) track.add(packet(number));
  Sweep sweep(64 * 6 * 5);
  fill(sweep, unit, 5, 0);
  CHECK(track.label(sweep, unit) == 4 * 384);
  CHECK(sweep.label[2 * 384 + 5] == 0);
  CHECK(sweep.label[3 * 384 + 5] == expected(3, 0, 5));
}

TEST_CASE("other and damaged files are refused", "[simulator][labels]") {
  const test::TemporaryPath file(".labels");
  REQUIRE_THROWS_AS(LabelTrack(file.path()), Error);
  std::ofstream(file.path())
      << "no labels at all, but long enough to be read as a header of a file with some";
  REQUIRE_THROWS_WITH(LabelTrack(file.path()), Catch::Contains("no file of packet labels"));
  for (const auto& [period_ns, firings] : {std::pair{1, 6}, std::pair{48'000, 3}, std::pair{57'600, 12}}) {
    LabelWriter writer(file.path(), period_ns, firings);
    writer.write(packet(0));
    writer.flush();
    REQUIRE_THROWS_WITH(LabelTrack(file.path()), Catch::Contains("no file of packet labels"));
  }
  {
    LabelWriter writer(file.path(), 48'000, 6);
    writer.write(packet(0));
    writer.flush();
  }
  std::filesystem::resize_file(file.path(), std::filesystem::file_size(file.path()) - 5);
  REQUIRE_THROWS_WITH(LabelTrack(file.path()), Catch::Contains("ends inside"));
}
