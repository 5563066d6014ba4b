// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <vector>

#include "pago/hdl64/packet_decoder.hpp"
#include "support/capture.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/packet_builder.hpp"
#include "support/reference_decoder.hpp"

using namespace pago;
using namespace pago::hdl64;

namespace {

constexpr double kMinRange_m = 0.9, kMaxRange_m = 120.0;

/// The decoder held against the plain double-precision reference, return by return, given the same azimuth.
class Comparison {
 public:
  explicit Comparison(const Calibration& calibration)
      : calibration_(calibration), decoder_(calibration, kMinRange_m, kMaxRange_m) {}

  /// `rotation` at the packet's first firing.
  void packet(const PacketView& packet, const Rotation& rotation) {
    decoder_.decode(packet, rotation, out_);
    for (int firing = 0; firing < kFirings; ++firing) compare_firing(packet, firing, rotation);
  }

  double worst_m() const { return worst_m_; }
  double worst_intensity() const { return worst_intensity_; }
  std::size_t returns() const { return returns_; }
  std::size_t wrong() const { return wrong_; }

 private:
  void compare_firing(const PacketView& packet, int firing, const Rotation& rotation) {
    const FiringReturns& out = out_.strongest[static_cast<std::size_t>(firing)];
    for (int laser = 0; laser < kLasers; ++laser) {
      const double time_s = firing * 48e-6 + laser_time_ns(laser) * 1e-9;
      const test::ReferenceReturn expected = test::reference_return(
          calibration_, laser, packet.distance_raw(firing, laser), packet.intensity(firing, laser),
          rotation.azimuth_rad + rotation.rate_rad_s * time_s, kMinRange_m, kMaxRange_m);
      const bool is_valid = (out.valid >> laser & 1U) != 0;
      if (is_valid != expected.is_valid) ++wrong_;
      if (is_valid && expected.is_valid) compare(expected, out, static_cast<std::size_t>(laser));
    }
  }
  void compare(const test::ReferenceReturn& expected, const FiringReturns& out, std::size_t i) {
    const double error_m = std::hypot(double{out.x_m[i]} - expected.x_m, double{out.y_m[i]} - expected.y_m,
                                      double{out.z_m[i]} - expected.z_m);
    worst_m_ = std::max(worst_m_, error_m);
    worst_intensity_ = std::max(worst_intensity_, std::abs(out.intensity[i] - expected.intensity));
    ++returns_;
  }

  Calibration calibration_;
  PacketDecoder decoder_;
  PacketReturns out_{};
  double worst_m_ = 0.0, worst_intensity_ = 0.0;
  std::size_t returns_ = 0, wrong_ = 0;
};

/// Every 7th packet of a recording, from its first header azimuth on at 10 Hz.
void check_recording(const std::filesystem::path& capture, const std::filesystem::path& calibration) {
  const std::vector<test::CapturedPacket> packets = test::read_capture(capture);
  REQUIRE(packets.size() > 8000);
  for (const VerticalOffset reading : {VerticalOffset::kVertical, VerticalOffset::kPerpendicular}) {
    Comparison comparison(load_calibration(calibration, reading));
    for (std::size_t i = 0; i < packets.size(); i += 7) {
      REQUIRE(check_packet(packets[i].payload) == PacketFault::kNone);
      const PacketView packet{std::span<const std::uint8_t, kPacketBytes>(packets[i].payload)};
      comparison.packet(packet, {packet.azimuth_cdeg(0) * 3.14159265358979323846 / 18000.0, 62.8});
    }
    INFO(capture << ": worst of " << comparison.returns() << " returns " << comparison.worst_m() << " m");
    CHECK(comparison.returns() > packets.size() / 7 * 100);
    CHECK(comparison.wrong() == 0);
    CHECK(comparison.worst_m() < 1e-4);
    CHECK(comparison.worst_intensity() < 0.5 + 1e-3);
  }
}

/// Any unit within the limits of plausible files.
Calibration random_unit(std::mt19937& random) {
  const auto within = [&random](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  Calibration unit;
  for (LaserCalibration& laser : unit.lasers) {
    laser.rotation_rad = within(-0.26, 0.26);
    laser.vertical_rad = within(-0.52, 0.52);
    laser.distance_m = within(0.0, 2.4);
    laser.distance_x_m = laser.distance_m + within(-0.2, 0.2);
    laser.distance_y_m = laser.distance_m + within(-0.2, 0.2);
    laser.vertical_offset_m = within(0.0, 0.3);
    laser.horizontal_offset_m = within(-0.05, 0.05);
    laser.focal_distance_m = within(0.0, 30.0);
    laser.focal_slope = within(0.0, 2.0);
    laser.min_intensity = static_cast<std::uint8_t>(within(0.0, 90.0));
    laser.max_intensity = static_cast<std::uint8_t>(within(200.0, 255.0));
  }
  unit.ring_of_laser = rank_rings(unit.lasers);
  return unit;
}

}  // namespace

TEST_CASE("real returns of a drive agree with double precision to 0.1 mm", "[hdl64][decoder_precision]") {
  PAGO_DATA_OR_SKIP(folder, "packets/drive_0005");
  check_recording(folder / "drive_0005.pcap", folder / "calibration.yaml");
}

TEST_CASE("returns with real calibration offsets agree with double precision to 0.1 mm",
          "[hdl64][decoder_precision]") {
  PAGO_DATA_OR_SKIP(folder, "packets/lab_urban");
  check_recording(folder / "packets.pcap", folder / "calibration.xml");
}

TEST_CASE("two-point corrected returns agree with double precision to 0.1 mm", "[hdl64][decoder_precision]") {
  PAGO_DATA_OR_SKIP(packets, "packets/synthetic");
  PAGO_DATA_OR_SKIP(calibration, "packets/calibration");
  check_recording(packets / "synth_S2.pcap", calibration / "ros-drivers_64e_s2.1-sztaki.xml");
  check_recording(packets / "synth_S3.pcap", calibration / "ros-drivers_64e_s3-xiesc.yaml");
}

TEST_CASE("any plausible unit agrees with double precision to 0.1 mm at any speed",
          "[hdl64][decoder_precision]") {
  std::mt19937 random(20260101);
  std::uniform_int_distribution<int> raw(0, 65535), byte(0, 255);
  std::uniform_real_distribution<double> azimuth(-10.0, 10.0), rate(-126.0, 126.0);
  std::size_t returns = 0;
  for (int round = 0; round < 200; ++round) {
    Calibration unit = random_unit(random);
    if (round % 2 == 1) unit.vertical_offset = VerticalOffset::kPerpendicular;
    test::PacketBuilder builder;
    for (int firing = 0; firing < kFirings; ++firing)
      for (int laser = 0; laser < kLasers; ++laser)
        builder.slot(firing, laser, round % 3 == 0 ? raw(random) % 13000 : raw(random), byte(random));
    Comparison comparison(unit);
    comparison.packet(builder.view(), {azimuth(random), rate(random)});
    INFO("round " << round);
    CHECK(comparison.wrong() == 0);
    CHECK(comparison.worst_m() < 1e-4);
    CHECK(comparison.worst_intensity() < 0.5 + 1e-3);
    returns += comparison.returns();
  }
  CHECK(returns > 60'000);
}
