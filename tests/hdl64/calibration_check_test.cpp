// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/calibration_check.hpp"

#include <vector>

#include "hdl64/made_up_unit.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::hdl64;
using test::some_unit;

TEST_CASE("another unit's calibration is told by how far it is off", "[hdl64][calibration_check]") {
  const Calibration a = some_unit(1);
  CHECK_FALSE(compare(a.lasers, a.lasers).is_other_unit());
  CHECK(complaint_about(compare(a.lasers, a.lasers), "db.xml").empty());
  Calibration b = a;
  for (LaserCalibration& laser : b.lasers) laser.vertical_rad += 0.04 * kDegree;
  CHECK_FALSE(compare(a.lasers, b.lasers).is_other_unit());
  b.lasers[12].vertical_rad += 1.2 * kDegree;
  const CalibrationDifference difference = compare(a.lasers, b.lasers);
  CHECK(difference.vertical_deg == Approx(0.04 + 1.2 / 64.0));
  CHECK(difference.max_vertical_deg == Approx(1.24));
  CHECK(difference.worst_laser == 12);
  CHECK(difference.is_other_unit());
  CHECK_THAT(complaint_about(difference, "db.xml"),
             Catch::Contains("wrong calibration: db.xml") && Catch::Contains("laser 12, by 1.24 deg"));
  CHECK(compare(a.lasers, some_unit(2).lasers).is_other_unit());
}

TEST_CASE("real units' files are told from each other", "[hdl64][calibration_check]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  std::vector<Calibration> units;
  for (const char* name :
       {"ros-drivers_64e_s2.1-sztaki.xml", "ros-drivers_64e_s3-xiesc.yaml", "ros-drivers_64e_utexas.yaml",
        "veloview_HDL-64.xml", "ajaayc_db.xml", "jmaye_calib-HDL-64E.xml", "mdamien_db.xml"})
    units.push_back(load_calibration(folder / name, VerticalOffset::kVertical));
  for (std::size_t i = 0; i < units.size(); ++i)
    for (std::size_t j = 0; j < units.size(); ++j) {
      INFO(units[i].origin << " and " << units[j].origin);
      CHECK(compare(units[i].lasers, units[j].lasers).is_other_unit() == (i != j));
    }
}
