// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/calibration.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "calibration_text.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::hdl64;
using namespace pago::test;

TEST_CASE("every HDL-64E file loads with plausible figures", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  int num_loaded = 0;
  for (const char* name :
       {"ajaayc_db.xml", "jmaye_calib-HDL-64E.xml", "mdamien_db.xml", "nebula_HDL64e_s2.yaml",
        "nebula_HDL64e_s3.yaml", "nebula_HDL64e_utexas.yaml", "ros-drivers_64e_s2.1-sztaki.xml",
        "ros-drivers_64e_s2.1-sztaki.yaml", "ros-drivers_64e_s3-xiesc.yaml", "ros-drivers_64e_utexas.yaml",
        "ros-drivers_issue_84_float_intensities.yaml", "ros-drivers_test_db_without_intensities.xml",
        "valgur_HDL-64E_S1-utexas.yml", "valgur_HDL-64E_S2.1-sztaki.yml", "valgur_HDL-64E_S3-VeloView.yml",
        "valgur_HDL-64E_S3-xiesc.yml", "veloview_HDL-64.xml", "xiesc_S3-Unit1090_2017-02-15_db.yaml"}) {
    INFO(name);
    const Calibration c = load_calibration(folder / name, VerticalOffset::kVertical);
    const auto [low, high] =
        std::minmax_element(c.lasers.begin(), c.lasers.end(),
                            [](const auto& a, const auto& b) { return a.vertical_rad < b.vertical_rad; });
    CHECK(low->vertical_rad / kDegree == Approx(-24.5).margin(0.6));
    CHECK(high->vertical_rad / kDegree == Approx(3.4).margin(1.6));
    CHECK(c.distance_lsb_m == 0.002);
    CHECK(c.origin == (folder / name).string());
    ++num_loaded;
  }
  CHECK(num_loaded == 18);
}

TEST_CASE("figures come out of db.xml in radians and metres", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  const Calibration c =
      load_calibration(folder / "ros-drivers_64e_s2.1-sztaki.xml", VerticalOffset::kPerpendicular);
  // Read off the file by eye: laser 1, and the lists of intensities.
  const LaserCalibration& laser = c.lasers[1];
  CHECK(laser.rotation_rad == Approx(-3.967427 * kDegree).epsilon(1e-12));
  CHECK(laser.vertical_rad == Approx(-8.3563347 * kDegree).epsilon(1e-12));
  CHECK(laser.distance_m == Approx(1.5145139).epsilon(1e-12));
  CHECK(laser.distance_x_m == Approx(1.525696).epsilon(1e-12));
  CHECK(laser.distance_y_m == Approx(1.5491043).epsilon(1e-12));
  CHECK(laser.vertical_offset_m == Approx(0.19601112).epsilon(1e-12));
  CHECK(laser.horizontal_offset_m == Approx(-0.025999999).epsilon(1e-12));
  CHECK(laser.focal_distance_m == Approx(5.0).epsilon(1e-12));
  CHECK(laser.focal_slope == 1.0);
  CHECK(laser.min_intensity == 30);
  CHECK(laser.max_intensity == 255);
  CHECK(c.lasers[0].max_intensity == 235);
  CHECK(laser.enabled);
  CHECK(c.two_point);
  CHECK(c.vertical_offset == VerticalOffset::kPerpendicular);
}

TEST_CASE("one unit's db.xml and yaml agree to the printed precision", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  const Calibration xml =
      load_calibration(folder / "ros-drivers_64e_s2.1-sztaki.xml", VerticalOffset::kVertical);
  for (const char* name :
       {"ros-drivers_64e_s2.1-sztaki.yaml", "valgur_HDL-64E_S2.1-sztaki.yml", "nebula_HDL64e_s2.yaml"}) {
    INFO(name);
    const Calibration yaml = load_calibration(folder / name, VerticalOffset::kVertical);
    for (std::size_t i = 0; i < 64; ++i) {
      const LaserCalibration &a = xml.lasers[i], &b = yaml.lasers[i];
      CHECK(std::abs(a.rotation_rad - b.rotation_rad) < 1e-12);
      CHECK(std::abs(a.vertical_rad - b.vertical_rad) < 1e-12);
      CHECK(std::abs(a.distance_m - b.distance_m) < 1e-12);
      CHECK(std::abs(a.distance_x_m - b.distance_x_m) < 1e-12);
      CHECK(std::abs(a.distance_y_m - b.distance_y_m) < 1e-12);
      CHECK(std::abs(a.vertical_offset_m - b.vertical_offset_m) < 1e-12);
      CHECK(std::abs(a.horizontal_offset_m - b.horizontal_offset_m) < 1e-12);
      CHECK(std::abs(a.focal_distance_m - b.focal_distance_m) < 1e-12);
      CHECK(std::abs(a.focal_slope - b.focal_slope) < 1e-12);
    }
    CHECK(xml.ring_of_laser == yaml.ring_of_laser);
    // The converter that made these yaml files dropped the zeros before it numbered the intensities: the same
    // values in the same order, on the wrong lasers.
    std::vector<int> minima_xml, minima_yaml;
    for (std::size_t i = 0; i < 64; ++i) {
      if (xml.lasers[i].min_intensity > 0) minima_xml.push_back(xml.lasers[i].min_intensity);
      if (yaml.lasers[i].min_intensity > 0) minima_yaml.push_back(yaml.lasers[i].min_intensity);
    }
    CHECK(minima_xml == minima_yaml);
  }
}

TEST_CASE("rings follow the vertical angles of this unit", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  // Most units share this order of the upper block from the top (notes, section 6); the lower repeats it
  // + 32.
  const std::vector<int> usual = {29, 28, 25, 24, 3,  2,  31, 30, 27, 26, 21, 20, 17, 16, 13, 12,
                                  23, 22, 19, 18, 15, 14, 9,  8,  5,  4,  1,  0,  11, 10, 7,  6};
  const Calibration c = load_calibration(folder / "veloview_HDL-64.xml", VerticalOffset::kVertical);
  for (std::size_t i = 0; i < 32; ++i) {
    const auto laser = static_cast<std::size_t>(usual[i]);
    CHECK(c.ring_of_laser[laser] == 63 - i);
    CHECK(c.ring_of_laser[laser + 32] == 31 - i);
  }
  // The S2.1 of SZTAKI interleaves its two blocks between -9 and -11 degrees.
  const Calibration interleaved =
      load_calibration(folder / "ros-drivers_64e_s2.1-sztaki.xml", VerticalOffset::kVertical);
  const auto lowest_upper =
      *std::min_element(interleaved.ring_of_laser.begin(), interleaved.ring_of_laser.begin() + 32);
  const auto highest_lower =
      *std::max_element(interleaved.ring_of_laser.begin() + 32, interleaved.ring_of_laser.end());
  CHECK(lowest_upper < highest_lower);
}

TEST_CASE("ranks are a permutation, equal angles in order of ids", "[hdl64][calibration]") {
  std::array<LaserCalibration, 64> lasers{};
  std::array<std::uint8_t, 64> identity;
  std::iota(identity.begin(), identity.end(), std::uint8_t{0});
  CHECK(rank_rings(lasers) == identity);
  for (std::size_t i = 0; i < 64; ++i) lasers[i].vertical_rad = -0.01 * static_cast<double>(i);
  const auto ranks = rank_rings(lasers);
  CHECK(std::equal(ranks.begin(), ranks.end(), identity.rbegin()));
}

TEST_CASE("a missing near point is the far one", "[hdl64][calibration]") {
  std::vector<YamlLaser> lasers = yaml_lasers();
  for (YamlLaser& laser : lasers) laser.rest += ", dist_correction_x: 0, dist_correction_y: 0";
  const Calibration zeros = load_text(yaml_text(lasers));
  CHECK_FALSE(zeros.two_point);
  CHECK(zeros.lasers[7].distance_x_m == 1.2);
  CHECK(zeros.lasers[7].distance_y_m == 1.2);

  lasers = yaml_lasers();
  lasers[3].rest += ", dist_correction_x: 1.25, two_pt_correction_available: true";
  lasers[4].rest += ", dist_correction_x: 1.25, two_pt_correction_available: false";
  const Calibration mixed = load_text(yaml_text(lasers));
  CHECK(mixed.two_point);
  CHECK(mixed.lasers[3].distance_x_m == 1.25);
  CHECK(mixed.lasers[3].distance_y_m == 1.2);
  CHECK(mixed.lasers[4].distance_x_m == 1.2);
}
