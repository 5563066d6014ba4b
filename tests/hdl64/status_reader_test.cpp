// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/status_reader.hpp"

#include <random>

#include "hdl64/made_up_unit.hpp"
#include "pago/hdl64/calibration_check.hpp"
#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/packet_builder.hpp"
#include "support/status_cycle.hpp"

using namespace pago;
using namespace pago::hdl64;
using test::some_unit;
using test::StatusCycle;
using test::StatusOptions;

namespace {

StatusOptions s3_options() {
  StatusOptions options;
  options.says = {.time = {12, 34, 56},
                  .date = {22, 11, 26},
                  .gps = GpsState::kFixed,
                  .temperature_c = 31,
                  .firmware = 0x47,
                  .warnings = kLensDirty | kPulsePresent,
                  .return_mode = ReturnMode::kStrongest,
                  .power_level = 0xA8,
                  .upper_threshold = 24,
                  .lower_threshold = 25,
                  .motor_rpm = 600,
                  .view_start_cdeg = 100,
                  .view_end_cdeg = 36000,
                  .life_hours = 4321,
                  .source_ipv4 = 0xC0A8032B,
                  .destination_ipv4 = 0xC0A803FF,
                  .calibrated = {26, 7, 1, 12, 5, 9},
                  .humidity_percent = 30};
  return options;
}
StatusOptions s2_options() {
  StatusOptions options = s3_options();
  options.is_s3 = false;
  options.says.return_mode = ReturnMode::kStrongest;
  return options;
}

/// Packets of a stream that started somewhere in its round.
class Stream {
 public:
  explicit Stream(const StatusCycle& cycle, std::size_t start = 0) : cycle_(cycle), next_(start) {}

  /// Gives `n` packets, of which those that `is_lost(i)` never come.
  template <typename IsLost>
  void give(StatusReader& reader, int n, IsLost is_lost) {
    for (int i = 0; i < n; ++i, ++next_, ++packets_on_) {
      if (is_lost(i)) continue;
      const test::StatusByte byte = cycle_[next_ % cycle_.size()];
      reader.add(byte.type, byte.value, packets_on_);
      packets_on_ = 0;
    }
  }
  void give(StatusReader& reader, int n) {
    give(reader, n, [](int) { return false; });
  }
  void skip_silently(std::size_t packets) { next_ += packets; }

 private:
  const StatusCycle& cycle_;
  std::size_t next_;
  std::int64_t packets_on_ = 1;
};

double largest_difference(const Calibration& a, const std::array<LaserCalibration, 64>& b) {
  double worst = 0.0;
  for (std::size_t i = 0; i < 64; ++i) {
    const LaserCalibration &x = a.lasers[i], &y = b[i];
    for (const double d :
         {x.vertical_rad - y.vertical_rad, x.rotation_rad - y.rotation_rad, x.distance_m - y.distance_m,
          x.distance_x_m - y.distance_x_m, x.distance_y_m - y.distance_y_m,
          x.vertical_offset_m - y.vertical_offset_m, x.horizontal_offset_m - y.horizontal_offset_m,
          x.focal_distance_m - y.focal_distance_m, x.focal_slope - y.focal_slope,
          double(x.min_intensity) - y.min_intensity, double(x.max_intensity) - y.max_intensity})
      worst = std::max(worst, std::abs(d));
  }
  return worst;
}

}  // namespace

TEST_CASE("an S3's calibration is there after one round, wherever the stream starts", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  for (const std::size_t start : {0U, 1U, 9U, 17U, 2000U, 4150U, 4159U}) {
    INFO("from packet " << start);
    StatusReader reader;
    Stream stream(cycle, start);
    stream.give(reader, 4159);
    CHECK_FALSE(reader.has_calibration());
    CHECK(reader.progress() > 0.98);
    stream.give(reader, 16);
    REQUIRE(reader.checksum() == Checksum::kCrc);
    CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
    CHECK(reader.progress() == 1.0);
  }
}

TEST_CASE("without a CRC bytes count when two rounds agree", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s2_options());
  StatusReader reader;
  Stream stream(cycle, 777);
  stream.give(reader, 2 * 4160 - 16);
  CHECK_FALSE(reader.has_calibration());
  stream.give(reader, 32);
  REQUIRE(reader.checksum() == Checksum::kLength);
  CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
}

TEST_CASE("with another word where the checksum should be three rounds must agree", "[hdl64][status]") {
  StatusCycle cycle = test::make_status_cycle(some_unit(), s3_options());
  cycle[4159].value ^= 0x55U;
  StatusReader reader;
  Stream stream(cycle);
  stream.give(reader, 3 * 4160 - 1);
  CHECK_FALSE(reader.has_calibration());
  stream.give(reader, 1);
  CHECK(reader.checksum() == Checksum::kAgreed);
}

TEST_CASE("parameters come with the calibration", "[hdl64][status]") {
  for (const StatusOptions& options : {s3_options(), s2_options()}) {
    const StatusCycle cycle = test::make_status_cycle(some_unit(), options);
    StatusReader reader;
    Stream stream(cycle, 40);
    stream.give(reader, 2 * 4160 + 16);
    CHECK(reader.status() == options.says);
  }
}

TEST_CASE("time, GPS, temperature and firmware are there after 16 packets", "[hdl64][status]") {
  const StatusOptions options = s3_options();
  const StatusCycle cycle = test::make_status_cycle(some_unit(), options);
  StatusReader reader;
  CHECK(reader.status().gps == GpsState::kUnknown);
  Stream stream(cycle, 1234);
  stream.give(reader, 16);
  CHECK(reader.status().time == options.says.time);
  CHECK(reader.status().date == options.says.date);
  CHECK(reader.status().gps == GpsState::kFixed);
  CHECK(reader.status().temperature_c == 31);
  CHECK(reader.status().firmware == 0x47);
}

TEST_CASE("the GPS letter says what keeps the clock", "[hdl64][status]") {
  StatusReader reader;
  for (const auto& [letter, state] : {std::pair{'A', GpsState::kFixed},
                                      {'P', GpsState::kPulse},
                                      {'V', GpsState::kTime},
                                      {'\0', GpsState::kNone}}) {
    reader.add('G', static_cast<std::uint8_t>(letter), 1);
    CHECK(reader.status().gps == state);
  }
}

TEST_CASE("lost packets are filled in by later rounds", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  for (const unsigned percent : {1U, 5U, 20U, 50U}) {
    std::mt19937 random(percent);
    StatusReader reader;
    Stream stream(cycle, 100);
    int rounds = 0;
    for (; rounds < 30 && !reader.has_calibration(); ++rounds)
      stream.give(reader, 4160, [&](int) { return random() % 100 < percent; });
    INFO(percent << " % lost: " << rounds << " rounds");
    REQUIRE(reader.checksum() == Checksum::kCrc);
    CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
    CHECK(rounds <= (percent <= 5 ? 5 : 20));
  }
}

TEST_CASE("a burst of any length keeps the place in the round", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  for (const int burst : {1, 15, 16, 160, 4160, 12'345}) {
    INFO(burst << " packets");
    StatusReader reader;
    Stream stream(cycle);
    stream.give(reader, 2000);
    stream.give(reader, burst, [](int) { return true; });
    stream.give(reader, 4176);
    REQUIRE(reader.checksum() == Checksum::kCrc);
    CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
  }
}

TEST_CASE("damaged bytes are outvoted", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s2_options());
  std::mt19937 random(8);
  StatusReader reader;
  std::size_t rounds = 0;
  for (; rounds < 40 && !reader.has_calibration(); ++rounds)
    for (const test::StatusByte& byte : cycle) {
      const bool is_damaged = random() % 200 == 0;
      reader.add(byte.type, static_cast<std::uint8_t>(byte.value ^ (is_damaged ? random() % 256 : 0)), 1);
    }
  REQUIRE(reader.checksum() == Checksum::kLength);
  CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
  CHECK(rounds <= 8);
}

TEST_CASE("a sensor that says nothing while it looks elsewhere keeps its place", "[hdl64][status]") {
  // Field of view limited: 58 packets, then a silence of 289 periods in which the cycle stands still.
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  StatusReader reader;
  for (std::size_t i = 0; i < 3 * 4160 && !reader.has_calibration(); ++i) {
    const test::StatusByte byte = cycle[i % 4160];
    reader.add(byte.type, byte.value, i % 58 == 0 ? 290 : 1);
  }
  REQUIRE(reader.checksum() == Checksum::kCrc);
  CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
}

TEST_CASE("a place that turns out wrong is given up, and found again", "[hdl64][status]") {
  const Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  for (const std::size_t skipped : {1U, 7U, 100U, 1600U}) {
    INFO(skipped << " packets that nobody counted");
    StatusReader reader;
    Stream stream(cycle);
    stream.give(reader, 3000);
    stream.skip_silently(skipped);
    stream.give(reader, 3 * 4160);
    REQUIRE(reader.checksum() == Checksum::kCrc);
    CHECK(largest_difference(unit, reader.lasers()) < 1e-9);
  }
}

TEST_CASE("another unit on the same cable is read anew", "[hdl64][status]") {
  const Calibration first = some_unit(1), second = some_unit(2);
  const StatusCycle of_first = test::make_status_cycle(first, s3_options());
  const StatusCycle of_second = test::make_status_cycle(second, s3_options());
  StatusReader reader;
  Stream(of_first).give(reader, 5000);
  CHECK(largest_difference(first, reader.lasers()) < 1e-9);
  reader.lose_place();
  CHECK(reader.has_calibration());  // the old one, until a new one is whole
  Stream(of_second, 300).give(reader, 4176);
  CHECK(largest_difference(second, reader.lasers()) < 1e-9);
}

TEST_CASE("warnings come and go at once on an S3", "[hdl64][status]") {
  StatusReader reader;
  reader.add('W', kTooHot | kGpsPresent, 1);
  CHECK(warnings_of(reader.status()) == std::vector<std::string>{"too hot (above 58 C)"});
  reader.add('W', kGpsPresent, 1);
  CHECK(warnings_of(reader.status()).empty());
}

TEST_CASE("the power level says what distances and intensities are", "[hdl64][status]") {
  StatusReader reader;
  CHECK(power_level_of(reader.status()) == PowerLevel::kPlain);
  for (const auto& [value, level] : {std::pair{std::uint8_t{0xA0}, PowerLevel::kRaw},
                                     {std::uint8_t{0xA8}, PowerLevel::kCorrected},
                                     {std::uint8_t{0x38}, PowerLevel::kPlain}}) {
    reader.add(0xF8, value, 1);
    CHECK(power_level_of(reader.status()) == level);
  }
}

TEST_CASE("figures that no unit has are refused, whatever the checksum says", "[hdl64][status]") {
  Calibration unit = some_unit();
  unit.lasers[30].vertical_rad = 80.0 * kDegree;
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  StatusReader reader;
  Stream(cycle).give(reader, 4 * 4160);
  CHECK_FALSE(reader.has_calibration());
  CHECK_FALSE(reader.calibration(VerticalOffset::kVertical).has_value());
}

TEST_CASE("zeros and noise are no calibration", "[hdl64][status]") {
  StatusReader zeros, noise;
  std::mt19937 random(3);
  for (int i = 0; i < 5 * 4160; ++i) {
    zeros.add(static_cast<std::uint8_t>("HMSDNYGTV1234567"[i % 16]), 0, 1);
    noise.add(static_cast<std::uint8_t>(random()), static_cast<std::uint8_t>(random()),
              static_cast<std::int64_t>(random() % 100'000) - 20);
  }
  CHECK_FALSE(zeros.has_calibration());
  CHECK_FALSE(noise.has_calibration());
}

TEST_CASE("a calibration from the stream ranks its rings and says where it came from", "[hdl64][status]") {
  Calibration unit = some_unit();
  const StatusCycle cycle = test::make_status_cycle(unit, s3_options());
  StatusReader reader;
  Stream(cycle).give(reader, 4160);
  const auto calibration = reader.calibration(VerticalOffset::kPerpendicular);
  REQUIRE(calibration.has_value());
  CHECK(calibration->ring_of_laser == rank_rings(unit.lasers));
  CHECK(calibration->two_point);
  CHECK(calibration->vertical_offset == VerticalOffset::kPerpendicular);
  CHECK(calibration->distance_lsb_m == 0.002);
  CHECK_THAT(calibration->origin, Catch::Contains("status bytes"));
}

TEST_CASE("synthetic captures carry the calibration they were made with", "[hdl64][status]") {
  struct Case {
    const char *capture, *calibration;
    Checksum checksum;
    std::size_t packets;
  };
  for (const Case& c :
       {Case{"synthetic/synth_S2.pcap", "calibration/ros-drivers_64e_s2.1-sztaki.xml", Checksum::kLength,
             8320},
        Case{"synthetic/synth_S3.pcap", "calibration/ros-drivers_64e_s3-xiesc.yaml", Checksum::kCrc, 4160},
        Case{"synthetic/synth_S3D.pcap", "calibration/ros-drivers_64e_s3-xiesc.yaml", Checksum::kCrc, 4160},
        Case{"lab_urban/packets.pcap", "lab_urban/calibration.xml", Checksum::kLength, 8320},
        Case{"lab_rural/packets.pcap", "lab_rural/calibration.xml", Checksum::kLength, 8320}}) {
    PAGO_DATA_OR_SKIP(folder, "packets");
    INFO(c.capture);
    StatusReader reader;
    for (const auto& packet : test::read_capture(folder / c.capture, c.packets)) {
      const PacketView view(std::span(packet.payload).first<kPacketBytes>());
      reader.add(view.status_type(), view.status_value(), 1);
    }
    REQUIRE(reader.checksum() == c.checksum);
    const Calibration file = load_calibration(folder / c.calibration, VerticalOffset::kVertical);
    const CalibrationDifference difference = compare(file.lasers, reader.lasers());
    CHECK(difference.max_vertical_deg < 0.0051);
    CHECK(difference.max_rotation_deg < 0.0051);
    CHECK(difference.max_distance_m < 0.00051);
    CHECK_FALSE(difference.is_other_unit());
    CHECK(reader.calibration(VerticalOffset::kVertical)->ring_of_laser == file.ring_of_laser);
  }
}

TEST_CASE("the drive without any in-band calibration gives none", "[hdl64][status]") {
  PAGO_DATA_OR_SKIP(file, "packets/drive_0005/drive_0005.pcap");
  StatusReader reader;
  for (const auto& packet : test::read_capture(file, 13'000)) {
    const PacketView view(std::span(packet.payload).first<kPacketBytes>());
    reader.add(view.status_type(), view.status_value(), 1);
  }
  CHECK_FALSE(reader.has_calibration());
  CHECK(reader.status().gps == GpsState::kFixed);
}
