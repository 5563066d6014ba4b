// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Every return of the recordings, against a plain reference in double precision that is given the same
// azimuth; and the azimuth itself, against the true rotation of the synthetic recording.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "pago/hdl64/packet_decoder.hpp"
#include "pago/hdl64/rotation_tracker.hpp"
#include "support/capture.hpp"
#include "support/reference_decoder.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using namespace pago::hdl64;
using claims::recording;
using claims::Report;

namespace {

constexpr double kMaxPointError_mm = 0.1;
constexpr double kMaxAzimuthError_deg = 0.01;

constexpr double kMinRange_m = 0.9, kMaxRange_m = 120.0;
constexpr std::size_t kPrimed = 64;  // packets, as the program does
/// An encoder that counts down to its last step shows half a step less than the truth in the mean.
constexpr double kEncoderFloor_deg = 0.045;

PacketView view_of(const test::CapturedPacket& packet) {
  if (check_packet(packet.payload) != PacketFault::kNone) throw std::runtime_error("a packet is damaged");
  return PacketView(std::span<const std::uint8_t, kPacketBytes>(packet.payload));
}

/// Header azimuths against device time, which is carried on over the hour.
std::vector<PacketAzimuths> headers_of(const std::vector<test::CapturedPacket>& packets) {
  std::vector<PacketAzimuths> headers;
  std::int64_t hours_us = 0, last_us = 0;
  for (const test::CapturedPacket& packet : packets) {
    const PacketView view = view_of(packet);
    if (std::int64_t{view.stamp_us()} < last_us - std::int64_t{kStampWrap_us} / 2) hours_us += kStampWrap_us;
    last_us = view.stamp_us();
    headers.push_back(PacketAzimuths::of(view, (hours_us + last_us) * 1000));
  }
  return headers;
}

/// Calls `use(packet, firing, time_ns, tracker)` for every firing, as the fitted rotation goes along.
template <typename Use>
void follow(const std::vector<PacketAzimuths>& headers, Use use) {
  RotationTracker tracker;
  tracker.prime(std::span(headers).first(std::min(kPrimed, headers.size())), false);
  for (std::size_t i = 0; i < headers.size(); ++i) {
    if (!tracker.add(headers[i])) throw std::runtime_error("the rotation was lost");
    for (int firing = 0; firing < kFirings; ++firing)
      use(i, firing, headers[i].time_ns + firing * kFiringPeriod_ns, tracker);
  }
}

struct Difference {
  std::uint64_t returns = 0, wrong = 0;  // wrong: kept though it should not be, or the reverse
  double worst_m = 0.0;
};

void compare(const Calibration& unit,
             const PacketView& packet,
             int firing,
             const Rotation& rotation,
             const FiringReturns& decoded,
             Difference& difference) {
  for (int laser = 0; laser < kLasers; ++laser) {
    const double azimuth_rad = rotation.azimuth_rad + rotation.rate_rad_s * laser_time_ns(laser) * 1e-9;
    const test::ReferenceReturn expected =
        test::reference_return(unit, laser, packet.distance_raw(firing, laser),
                               packet.intensity(firing, laser), azimuth_rad, kMinRange_m, kMaxRange_m);
    const bool is_valid = (decoded.valid >> laser & 1U) != 0;
    difference.wrong += is_valid != expected.is_valid ? 1U : 0U;
    if (!is_valid || !expected.is_valid) continue;
    const auto i = static_cast<std::size_t>(laser);
    const double error_m =
        std::hypot(double{decoded.x_m[i]} - expected.x_m, double{decoded.y_m[i]} - expected.y_m,
                   double{decoded.z_m[i]} - expected.z_m);
    difference.worst_m = std::max(difference.worst_m, error_m);
    ++difference.returns;
  }
}

void measure_points(Report& report,
                    const std::string& capture,
                    const std::string& calibration,
                    VerticalOffset offset) {
  const auto packets = test::read_capture(recording(capture));
  const Calibration unit = load_calibration(recording(calibration), offset);
  PacketDecoder decoder(unit, kMinRange_m, kMaxRange_m);
  PacketReturns returns{};
  Difference difference;
  follow(headers_of(packets), [&](std::size_t i, int firing, std::int64_t time_ns, const auto& tracker) {
    const double turns = tracker.revolutions(time_ns);
    const Rotation rotation{2.0 * std::numbers::pi * (turns - std::floor(turns)),
                            2.0 * std::numbers::pi * tracker.rate_rev_s()};
    if (firing == 0) decoder.decode(view_of(packets[i]), rotation, returns);
    compare(unit, view_of(packets[i]), firing, rotation, returns.strongest[static_cast<std::size_t>(firing)],
            difference);
  });
  if (difference.returns == 0) throw std::runtime_error(capture + " has no returns");
  const std::string name = "decoding " + capture.substr(capture.find('/') + 1) + ": ";
  report.below(name + format("worst of %.1f million points", static_cast<double>(difference.returns) * 1e-6),
               1000.0 * difference.worst_m, kMaxPointError_mm, " mm");
  report.exactly(name + "wrongly kept or left out", difference.wrong, 0);
}

/// The line through all headers of a recording of constant speed, in revolutions against seconds.
struct Line {
  double start_rev = 0.0, rate_rev_s = 0.0;
  std::int64_t origin_ns = 0;

  double at(std::int64_t time_ns) const {
    return start_rev + rate_rev_s * static_cast<double>(time_ns - origin_ns) * 1e-9;
  }
};

Line least_squares(const std::vector<PacketAzimuths>& headers) {
  double n = 0, t1 = 0, t2 = 0, y = 0, ty = 0, turned = 0, last = 0;
  for (const PacketAzimuths& packet : headers) {
    for (int firing = 0; firing < kFirings; ++firing) {
      const double now = packet.azimuth_cdeg[static_cast<std::size_t>(firing)] / 36000.0;
      turned += n == 0 ? now : (now - last) - std::round(now - last);
      last = now;
      const double t =
          static_cast<double>(packet.time_ns - headers[0].time_ns + firing * kFiringPeriod_ns) * 1e-9;
      n += 1, t1 += t, t2 += t * t, y += turned, ty += t * turned;
    }
  }
  const double rate = (n * ty - t1 * y) / (n * t2 - t1 * t1);
  return {(y - rate * t1) / n, rate, headers[0].time_ns};
}

double wrapped_deg(double revolutions) {
  return (revolutions - std::round(revolutions)) * 360.0;
}

void measure_azimuth(Report& report) {
  const auto headers = headers_of(test::read_capture(recording("packets/synthetic/synth_S2.pcap")));
  const Line shown = least_squares(headers);
  const auto truth = [&](std::int64_t time_ns) { return shown.at(time_ns) + kEncoderFloor_deg / 360.0; };
  double worst_deg = 0.0, worst_header_deg = 0.0;
  follow(headers, [&](std::size_t i, int firing, std::int64_t time_ns, const auto& tracker) {
    worst_deg = std::max(worst_deg, std::abs(wrapped_deg(tracker.revolutions(time_ns) - truth(time_ns))));
    const double header = headers[i].azimuth_cdeg[static_cast<std::size_t>(firing)] / 36000.0;
    // The truth must lie between the step that the header shows and the next one.
    worst_header_deg =
        std::max(worst_header_deg, std::abs(wrapped_deg(truth(time_ns) - header) - kEncoderFloor_deg));
  });
  report.shown("synth_S2: speed of the true rotation", format("%.5f rev/s", shown.rate_rev_s));
  report.at_most("synth_S2: headers from the middle of the step that the truth is in", worst_header_deg,
                 kEncoderFloor_deg + 0.005, " deg");  // headers are rounded to 0.01 degrees
  report.at_most("synth_S2: fitted azimuth from the true one, worst firing", worst_deg, kMaxAzimuthError_deg,
                 " deg");
}

}  // namespace

int main() {
  return claims::run("decoding", [](Report& report) {
    measure_points(report, "packets/drive_0005/drive_0005.pcap", "packets/drive_0005/calibration.yaml",
                   VerticalOffset::kVertical);
    measure_points(report, "packets/lab_urban/packets.pcap", "packets/lab_urban/calibration.xml",
                   VerticalOffset::kPerpendicular);
    measure_points(report, "packets/synthetic/synth_S2.pcap",
                   "packets/calibration/ros-drivers_64e_s2.1-sztaki.xml", VerticalOffset::kVertical);
    measure_points(report, "packets/synthetic/synth_S3.pcap",
                   "packets/calibration/ros-drivers_64e_s3-xiesc.yaml", VerticalOffset::kVertical);
    measure_azimuth(report);
  });
}
