// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <map>
#include <random>

#include "pago/core/sweep.hpp"
#include "pago/hdl64/packet_decoder.hpp"
#include "support/catch.hpp"
#include "support/packet_stream.hpp"

using namespace pago;
using namespace pago::hdl64;
using pago::test::PacketBuilder;

namespace {

struct Seen {
  int raw, intensity;
};

/// A packet in dual-return mode whose laser `laser` saw these two in firing 1.
PacketBuilder packet_of(int laser, Seen first, Seen second) {
  const int upper_or_lower = laser / 32;
  PacketBuilder builder;
  builder.block_slot(4 + upper_or_lower, laser % 32, first.raw, first.intensity);
  builder.block_slot(6 + upper_or_lower, laser % 32, second.raw, second.intensity);
  return builder;
}

PacketReturns decode(const PacketBuilder& builder) {
  Calibration unit;
  PacketDecoder decoder(unit, 0.9, 120.0);
  decoder.set_format(test::dual_return());
  PacketReturns out{};
  decoder.decode(builder.view(), {}, out);
  return out;
}

/// What came of it: distance in units of 2 mm, 0 if nothing; intensity; echo bits.
struct Told {
  int raw = 0, intensity = 0, echo = 0;
  bool operator==(const Told&) const = default;
};
Told tell(const FiringReturns& returns, std::size_t laser) {
  if ((returns.valid >> laser & 1U) == 0) return {};
  return {static_cast<int>(std::lround(returns.x_m[laser] / 0.002F)), returns.intensity[laser],
          returns.echo[laser]};
}

}  // namespace

TEST_CASE("two returns are told by brightness and distance, not by their place in the packet",
          "[hdl64][dual_return]") {
  struct Case {
    Seen first, second;
    Told strongest, other;
  };
  constexpr int kOnly = 0, kNeither = kNotLast | kNotStrongest;
  const Case cases[] = {
      {{1000, 90}, {2000, 40}, {1000, 90, kNotLast}, {2000, 40, kNotStrongest}},
      {{2000, 40}, {1000, 90}, {1000, 90, kNotLast}, {2000, 40, kNotStrongest}},
      {{2000, 90}, {1000, 40}, {2000, 90, kOnly}, {1000, 40, kNeither}},  // the last is the strongest
      {{1000, 40}, {2000, 90}, {2000, 90, kOnly}, {1000, 40, kNeither}},
      {{1000, 60}, {2000, 60}, {1000, 60, kNotLast}, {2000, 60, kNotStrongest}},  // as bright: the first
      {{2000, 60}, {1000, 60}, {2000, 60, kOnly}, {1000, 60, kNeither}},
      {{1500, 70}, {1500, 70}, {1500, 70, kOnly}, {}},  // one return, sent twice
      {{1500, 70}, {1500, 80}, {1500, 80, kOnly}, {}},
      {{1500, 70}, {0, 0}, {1500, 70, kOnly}, {}},
      {{0, 0}, {1500, 70}, {1500, 70, kOnly}, {}},
      {{0, 0}, {0, 0}, {}, {}},
      {{300, 200}, {1500, 70}, {1500, 70, kOnly}, {}},    // 0.6 m is too near to be believed
      {{1500, 70}, {65000, 200}, {1500, 70, kOnly}, {}},  // 130 m too far
      {{300, 200}, {65000, 70}, {}, {}},
  };
  for (const Case& c : cases) {
    INFO(c.first.raw << " " << c.second.raw);
    for (const std::size_t laser : {0U, 17U, 31U, 32U, 63U}) {
      const PacketReturns out = decode(packet_of(static_cast<int>(laser), c.first, c.second));
      CHECK(tell(out.strongest[1], laser) == c.strongest);
      CHECK(tell(out.others[1], laser) == c.other);
      CHECK((out.strongest[0].valid | out.strongest[2].valid | out.others[0].valid | out.others[2].valid) ==
            0);
    }
  }
}

TEST_CASE("of random pairs every return is given once, and at its place", "[hdl64][dual_return]") {
  std::mt19937 random(5);
  for (int round = 0; round < 300; ++round) {
    PacketBuilder builder;
    std::map<int, std::map<int, int>> sent;  // firing * 64 + laser -> raw -> brightest
    for (int block = 0; block < kBlocks; ++block)
      for (int laser = 0; laser < kLasersPerBlock; ++laser) {
        const int raw = random() % 3 == 0 ? 0 : 1000 + static_cast<int>(random() % 4) * 1000;
        const int intensity = static_cast<int>(random() % 256);
        builder.block_slot(block, laser, raw, intensity);
        if (raw == 0) continue;
        int& brightest = sent[block / 4 * 64 + block % 2 * 32 + laser][raw];
        brightest = std::max(brightest, intensity);
      }
    const PacketReturns out = decode(builder);
    for (std::size_t firing = 0; firing < 3; ++firing)
      for (std::size_t laser = 0; laser < kLasers; ++laser) {
        const auto& pair = sent[static_cast<int>(firing * 64 + laser)];
        const Told strongest = tell(out.strongest[firing], laser), other = tell(out.others[firing], laser);
        REQUIRE((strongest.raw != 0) + (other.raw != 0) == static_cast<int>(pair.size()));
        if (strongest.raw != 0) REQUIRE(pair.at(strongest.raw) == strongest.intensity);
        if (other.raw != 0) {
          REQUIRE(other.raw != strongest.raw);
          REQUIRE(other.intensity <= strongest.intensity);
          REQUIRE(((other.echo & kNotLast) == 0) == (other.raw > strongest.raw));
        }
      }
  }
}

TEST_CASE("the second returns of a firing have its azimuth and its lasers' times", "[hdl64][dual_return]") {
  PacketBuilder builder;
  for (int block = 0; block < kBlocks; ++block)
    for (int laser = 0; laser < kLasersPerBlock; ++laser)
      builder.block_slot(block, laser, block % 4 < 2 ? 10'000 : 20'000, block % 4 < 2 ? 90 : 30);
  Calibration unit;
  PacketDecoder decoder(unit, 0.9, 120.0);
  decoder.set_format(test::dual_return());
  PacketReturns out{};
  constexpr double kRate = 100.0;
  decoder.decode(builder.view(), {0.5, kRate}, out);
  for (std::size_t firing = 0; firing < 3; ++firing)
    for (std::size_t laser = 0; laser < kLasers; ++laser) {
      const double after_s = static_cast<double>(firing) * 57.6e-6 +
                             laser_time_ns(static_cast<int>(laser), kFiringPeriodS3_ns) * 1e-9;
      const double azimuth = 0.5 + kRate * after_s;
      CHECK(out.strongest[firing].x_m[laser] == Approx(20.0 * std::cos(azimuth)).margin(2e-5));
      CHECK(out.others[firing].x_m[laser] == Approx(40.0 * std::cos(azimuth)).margin(4e-5));
      CHECK(out.others[firing].y_m[laser] == Approx(-40.0 * std::sin(azimuth)).margin(4e-5));
    }
}
