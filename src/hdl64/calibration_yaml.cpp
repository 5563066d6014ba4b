// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include "calibration_file.hpp"
#include "pago/core/error.hpp"

// The yaml that velodyne_pointcloud's gen_calibration.py makes of a db.xml: `lasers`, a list of maps, in
// radians and metres; keys that equal a default are often left out.
namespace pago::hdl64 {
namespace {

int line_of(const YAML::Mark& mark) {
  return mark.line + 1;  // counted from 0, and -1 where unknown
}

YAML::Node parse(const std::string& name, std::string_view text) {
  try {
    return YAML::Load(std::string(text));
  } catch (const YAML::ParserException& fault) {
    throw Error(at_line(name, line_of(fault.mark)), "not well-formed YAML: " + fault.msg,
                "is the file cut short?");
  } catch (const YAML::Exception& fault) {
    throw Error(at_line(name, line_of(fault.mark)), "not readable as YAML: " + fault.msg);
  }
}

double number(const std::string& name, const char* key, const YAML::Node& node) {
  const std::optional<double> value = node.IsScalar() ? parse_number(node.Scalar()) : std::nullopt;
  if (!value)
    throw Error(at_line(name, line_of(node.Mark())),
                std::string(key) + " is " + (node.IsScalar() ? in_quotes(node.Scalar()) + ", not" : "not") +
                    " a number");
  return *value;
}

LaserEntry read_laser(const std::string& name, const YAML::Node& node) {
  LaserEntry laser{line_of(node.Mark()), -1, true, {}};
  if (!node.IsMap() || !node["laser_id"]) throw Error(at_line(name, laser.line), "a laser without laser_id");
  const double id = number(name, "laser_id", node["laser_id"]);
  laser.id = id >= 0.0 && id < 1000.0 ? static_cast<int>(id) : -1;
  for (std::size_t figure = 0; figure < kNumFigures; ++figure) {
    const char* key = kRosYaml[figure].key;
    if (const YAML::Node value = node[key]; value && !value.IsNull())
      laser.figures[figure] = number(name, key, value);
  }
  const YAML::Node two_point = node["two_pt_correction_available"];
  if (two_point && two_point.IsScalar() && two_point.Scalar() == "false")
    laser.figures[kDistanceX] = laser.figures[kDistanceY] = std::nullopt;
  return laser;
}

}  // namespace

CalibrationFile read_ros_yaml(const std::string& name, std::string_view text) {
  const YAML::Node root = parse(name, text);
  if (!root.IsMap() || !root["lasers"] || !root["lasers"].IsSequence())
    throw Error(name, "not a calibration: neither a Velodyne db.xml nor a yaml with a list of `lasers`");
  CalibrationFile file{name, kRosYaml, {}, {}};
  if (const YAML::Node lsb = root["distance_resolution"]) {
    file.distance_lsb_m = number(name, "distance_resolution", lsb);
    // gen_calibration.py writes its default in centimetres where the db.xml has no distLSB_.
    if (file.distance_lsb_m == 0.2) file.distance_lsb_m = 0.002;
  }
  for (const YAML::Node& laser : root["lasers"]) file.lasers.push_back(read_laser(name, laser));
  return file;
}

}  // namespace pago::hdl64
