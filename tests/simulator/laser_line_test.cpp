// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulator/laser_line.hpp"

#include <cmath>
#include <numbers>

#include "pago/simulator/unit.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"
#include "support/reference_decoder.hpp"

using namespace pago;
using namespace pago::simulator;

namespace {

Heading heading(double azimuth_rad, const hdl64::LaserCalibration& laser) {
  const double theta = azimuth_rad - laser.rotation_rad;
  return {std::cos(theta), std::sin(theta)};
}

/// Where the decoder's reference puts a raw distance.
Eigen::Vector3d decoded(const hdl64::Calibration& unit, int laser, int raw, double azimuth_rad) {
  const test::ReferenceReturn r = test::reference_return(unit, laser, raw, 0, azimuth_rad, 0.0, 200.0);
  return {r.x_m, r.y_m, r.z_m};
}

/// Worst distance between what the decoder makes of raw distances and the line that is said to hold them.
double worst_off_line_m(const hdl64::Calibration& unit) {
  double worst = 0.0;
  for (int laser = 0; laser < 64; ++laser) {
    const auto& figures = unit.lasers[static_cast<std::size_t>(laser)];
    const LaserLine line(figures, unit);
    for (const int raw : {500, 1500, 4000, 9000, 11000, 13000, 20000, 50000}) {
      // Not across the axes, where the near correction has its corners.
      for (const double azimuth : {0.3, 1.0, 2.0, 2.7, 3.6, 4.4, 5.2, 6.0}) {
        const double d = raw * unit.distance_lsb_m + figures.distance_m;
        const Heading at = heading(azimuth, figures);
        const Line on = d < LaserLine::kNearLimit_m ? line.near(at) : line.far(at);
        worst = std::max(worst, (on.foot + d * on.step - decoded(unit, laser, raw, azimuth)).norm());
      }
    }
  }
  return worst;
}

/// Planes at all distances, seen under all headings: how far off a plane its decoded points are, in the
/// direction of the beam and in distance steps.
double worst_off_plane_steps(const hdl64::Calibration& unit) {
  double worst = 0.0;
  for (int laser = 0; laser < 64; ++laser) {
    const auto& figures = unit.lasers[static_cast<std::size_t>(laser)];
    const LaserLine line(figures, unit);
    for (double azimuth = 0.0; azimuth < 6.28; azimuth += 0.1) {
      for (const double range : {2.0, 5.0, 12.0, 24.0, 26.0, 60.0, 110.0}) {
        const Heading at = heading(azimuth, figures);
        const Line beam = line.far(at);
        const Eigen::Vector3d point = beam.foot + range * beam.step;
        const Eigen::Vector3d normal =
            Eigen::Vector3d(1.0 + beam.step.x(), beam.step.y() - 0.5, 0.4).normalized();
        if (std::abs(normal.dot(beam.step)) < 0.2) continue;
        const int raw = static_cast<int>(std::lround(line.raw(line.measured_m(at, range, normal))));
        const double off = normal.dot(decoded(unit, laser, raw, azimuth) - point) / normal.dot(beam.step);
        worst = std::max(worst, std::abs(off) / unit.distance_lsb_m);
      }
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("a laser's returns lie on its line wherever the decoder puts them", "[simulator][laser_line]") {
  hdl64::Calibration unit = made_up_unit();
  CHECK(worst_off_line_m(unit) < 1e-9);
  unit.vertical_offset = VerticalOffset::kPerpendicular;
  CHECK(worst_off_line_m(unit) < 1e-9);
}

TEST_CASE("a plane comes out of the decoder as a plane, to half a distance step", "[simulator][laser_line]") {
  CHECK(worst_off_plane_steps(made_up_unit()) <= 0.55);
}

TEST_CASE("the same for real units", "[simulator][laser_line]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  for (const char* file : {"ros-drivers_64e_s2.1-sztaki.xml", "ajaayc_db.xml", "veloview_HDL-64.xml",
                           "xiesc_S3-Unit1090_2017-02-15_db.yaml"}) {
    INFO(file);
    const hdl64::Calibration unit = hdl64::load_calibration(folder / file, VerticalOffset::kVertical);
    CHECK(worst_off_line_m(unit) < 1e-9);
    CHECK(worst_off_plane_steps(unit) <= 0.55);
  }
}

TEST_CASE("ignoring the near point would move returns by centimetres", "[simulator][laser_line]") {
  const hdl64::Calibration unit = made_up_unit();
  double most = 0.0;
  for (const auto& figures : unit.lasers) {
    const LaserLine line(figures, unit);
    const Heading ahead{1.0, 0.0};
    most = std::max(most, std::abs(line.measured_m(ahead, 4.0, Eigen::Vector3d::UnitX()) - 4.0));
  }
  CHECK(most > 0.03);
}
