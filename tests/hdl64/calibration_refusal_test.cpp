// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <string>
#include <vector>

#include "calibration_text.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"
#include "support/data.hpp"

using namespace pago;
using namespace pago::hdl64;
using namespace pago::test;
using Catch::Matchers::Contains;

namespace {

/// What the Error says without the path; the sentence must be one line.
std::string refusal_of(const std::string& content) {
  try {
    load_text(content);
  } catch (const Error& error) {
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    const std::string name = std::filesystem::path(error.where()).filename();
    const std::size_t line = name.find(':');
    return (line == std::string::npos ? "" : "line " + name.substr(line + 1) + ": ") + error.problem();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("other sensors' files are refused by name", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  const auto refusal = [&folder = folder](const char* name) { return refusal_of(read_text(folder / name)); };
  CHECK_THAT(refusal("ros-drivers_32db.yaml"), Contains("an HDL-32E (32 lasers)"));
  CHECK_THAT(refusal("ros-drivers_VLP16db.yaml"), Contains("a VLP-16 (16 lasers)"));
  CHECK_THAT(refusal("ros-drivers_VLP16_hires_db.yaml"), Contains("a VLP-16 Hi-Res (16 lasers)"));
  CHECK_THAT(refusal("ros-drivers_VeloView-VLP-32C.yaml"), Contains("a VLP-32C (32 lasers)"));
  CHECK_THAT(refusal("ros-drivers_VLS128.yaml"), Contains("a VLS-128 (128 lasers)"));
}

TEST_CASE("other sensors' db.xml files are known by their switched-on lasers", "[hdl64][calibration]") {
  CHECK_THAT(refusal_of(xml_text(16, -15, 15)), Contains("a VLP-16 (16 lasers)"));
  CHECK_THAT(refusal_of(xml_text(32, -30.67, 10.67)), Contains("HDL-32E (32 lasers)"));
  const Calibration c = load_text(xml_text(63, -24.8, 2.0));
  CHECK(c.lasers[62].enabled);
  CHECK_FALSE(c.lasers[63].enabled);
}

TEST_CASE("every truncation of a db.xml is refused in one line", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  const std::string text = read_text(folder / "ajaayc_db.xml");
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  for (std::size_t size = 1; size < end; size += 997) {
    INFO(size);
    CHECK(refusal_of(text.substr(0, size)) != "accepted");
  }
  CHECK_THAT(refusal_of(text.substr(0, text.size() / 2)),
             Contains("line ") && Contains("not well-formed XML"));
}

TEST_CASE("a truncated yaml is refused wherever it is cut", "[hdl64][calibration]") {
  PAGO_DATA_OR_SKIP(folder, "packets/calibration");
  for (const char* name :
       {"ros-drivers_64e_s3-xiesc.yaml", "nebula_HDL64e_s2.yaml", "xiesc_S3-Unit1090_2017-02-15_db.yaml"}) {
    const std::string text = read_text(folder / name);
    const std::size_t end = text.rfind("vert_offset_correction");  // the last laser's last figure
    for (std::size_t size = 1; size < end; size += 499) {
      INFO(name << " " << size);
      CHECK(refusal_of(text.substr(0, size)) != "accepted");
    }
    CHECK(refusal_of(text.substr(0, end)) != "accepted");
  }
}

TEST_CASE("what is no calibration is refused with a reason", "[hdl64][calibration]") {
  CHECK_THAT(refusal_of(""), Contains("empty"));
  CHECK_THAT(refusal_of(" \n\t\n"), Contains("empty"));
  CHECK_THAT(refusal_of("hello world\n"), Contains("not a calibration"));
  CHECK_THAT(refusal_of("lasers: 64\n"), Contains("not a calibration"));
  CHECK_THAT(refusal_of("[1, 2, 3]\n"), Contains("not a calibration"));
  CHECK_THAT(refusal_of("a: [1, 2\nb: {"), Contains("not well-formed YAML"));
  CHECK_THAT(refusal_of("<html><body/></html>"), Contains("not a Velodyne db.xml"));
  CHECK_THAT(refusal_of(std::string("\xD4\xC3\xB2\xA1\x02\x00\x04\x00\x00\x00", 10)),
             Contains("YAML") || Contains("not a calibration"));
  CHECK_THAT(refusal_of(std::string(5U << 20U, 'x')), Contains("larger than 4 MiB"));
  CHECK_THAT(refusal_of("lasers: []\n"), Contains("has 0 lasers"));
  CHECK_THAT(refusal_of("lasers: [1, 2]\n"), Contains("without laser_id"));
}

TEST_CASE("a missing file and a folder are told apart", "[hdl64][calibration]") {
  CHECK_THROWS_WITH(load_calibration("/nowhere/db.xml", VerticalOffset::kVertical),
                    Contains("/nowhere/db.xml: cannot be opened"));
  CHECK_THROWS_WITH(load_calibration(std::filesystem::temp_directory_path(), VerticalOffset::kVertical),
                    Contains("is a folder"));
}

TEST_CASE("exactly lasers 0 to 63 are accepted", "[hdl64][calibration]") {
  CHECK(refusal_of(yaml_text(yaml_lasers())) == "accepted");
  CHECK_THAT(refusal_of(yaml_text(yaml_lasers(63))), Contains("has 63 lasers, an HDL-64E has 64"));
  CHECK_THAT(refusal_of(yaml_text(yaml_lasers(65))), Contains("line 66: a laser's id must be 0 to 63"));
  // Half of an HDL-64E's file is no HDL-32E.
  CHECK_THAT(refusal_of(yaml_text(yaml_lasers(32, -8.7, 2.0))), Contains("has 32 lasers, an HDL-64E has 64"));
  std::string twice = yaml_text(yaml_lasers());
  twice.replace(twice.find("laser_id: 9,"), 12, "laser_id: 8,");
  CHECK_THAT(refusal_of(twice), Contains("line 11: laser 8 is given twice"));
}

TEST_CASE("each figure has its limits, named with the laser and its line", "[hdl64][calibration]") {
  const auto with = [](auto change) {
    std::vector<YamlLaser> lasers = yaml_lasers();
    change(lasers[5]);
    return refusal_of(yaml_text(lasers));
  };
  CHECK_THAT(with([](YamlLaser& l) { l.vert = "0.6"; }),
             Contains("line 7: vert_correction of laser 5 is 0.6, must be within [-0.523599, 0.523599]"));
  CHECK_THAT(with([](YamlLaser& l) { l.rot = "-0.3"; }),
             Contains("line 7: rot_correction of laser 5 is -0.3"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = "120"; }), Contains("dist_correction of laser 5 is 120"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = "-0.1"; }), Contains("dist_correction of laser 5 is -0.1"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = "abc"; }),
             Contains("line 7: dist_correction is 'abc', not a number"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = ".nan"; }),
             Contains("dist_correction is '.nan', not a number"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = "'1,2'"; }),
             Contains("dist_correction is '1,2', not a number"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = "[1]"; }), Contains("dist_correction is not a number"));
  CHECK_THAT(with([](YamlLaser& l) { l.dist = ""; }), Contains("line 7: laser 5 has no dist_correction"));
  CHECK_THAT(with([](YamlLaser& l) { l.rest = "vert_offset_correction: 0.4"; }),
             Contains("vert_offset_correction of laser 5"));
  CHECK_THAT(with([](YamlLaser& l) { l.rest = "max_intensity: 10"; }),
             Contains("laser 5 has no vert_offset_correction"));
  CHECK_THAT(with([](YamlLaser& l) { l.rest += ", dist_correction_x: 1.45"; }),
             Contains("dist_correction_x of laser 5 is 0.2 m or more off"));
  CHECK_THAT(with([](YamlLaser& l) { l.rest += ", max_intensity: 256"; }),
             Contains("max_intensity of laser 5 is 256"));
  CHECK_THAT(with([](YamlLaser& l) { l.rest += ", max_intensity: 9, min_intensity: 10.0"; }),
             Contains("minimum intensity above its maximum"));
  CHECK(with([](YamlLaser& l) { l.rest += ", max_intensity: 11, min_intensity: 10.0"; }) == "accepted");
}

TEST_CASE("a wrong distance step is refused, the converter's slip is mended", "[hdl64][calibration]") {
  CHECK_THAT(refusal_of("distance_resolution: 0.004\n" + yaml_text(yaml_lasers())), Contains("0.004 m"));
  CHECK(load_text("distance_resolution: 0.2\n" + yaml_text(yaml_lasers())).distance_lsb_m == 0.002);
  CHECK(load_text(yaml_text(yaml_lasers())).distance_lsb_m == 0.002);
}
