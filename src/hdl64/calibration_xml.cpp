// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <pugixml.hpp>

#include "calibration_file.hpp"
#include "pago/core/error.hpp"

// Velodyne's db.xml, a boost_serialization archive: DB/{distLSB_, enabled_, minIntensity_, maxIntensity_} and
// DB/points_/item/px per laser.
namespace pago::hdl64 {
namespace {

class XmlReader {
 public:
  XmlReader(const std::string& name, std::string_view text) : text_(text), file_{name, kDbXml, {}, {}} {}

  CalibrationFile read() {
    parse();
    const pugi::xml_node db = document_.child("boost_serialization").child("DB");
    const pugi::xml_node points = db.child("points_");
    if (!points) throw Error(file_.name, "XML, but not a Velodyne db.xml: it has no DB/points_");
    if (const pugi::xml_node lsb = db.child("distLSB_")) file_.distance_lsb_m = 0.01 * number(lsb);
    for (const pugi::xml_node item : points.children("item")) read_laser(item.child("px"));
    read_list(db.child("enabled_"), [](LaserEntry& laser, double value) { laser.enabled = value != 0.0; });
    for (const Figure figure : {kMinIntensity, kMaxIntensity})
      read_list(db.child(kDbXml[figure].key),
                [figure](LaserEntry& laser, double value) { laser.figures[figure] = value; });
    return std::move(file_);
  }

 private:
  void parse() {
    const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
    if (!result)
      throw Error(at_line(file_.name, line_at(result.offset)),
                  "not well-formed XML: " + std::string(result.description()), "is the file cut short?");
  }

  void read_laser(const pugi::xml_node px) {
    LaserEntry laser{line_at(px.offset_debug()), -1, true, {}};
    const pugi::xml_node id = px.child("id_");
    if (!id) throw Error(at_line(file_.name, laser.line), "a laser without id_");
    const double value = number(id);  // VeloView writes "0.0"
    laser.id = value >= 0.0 && value < 1000.0 ? static_cast<int>(value) : -1;
    for (std::size_t figure = 0; figure < kNumFigures; ++figure)
      if (const pugi::xml_node node = px.child(kDbXml[figure].key)) laser.figures[figure] = number(node);
    file_.lasers.push_back(laser);
  }

  // A list of one item per laser, in order of ids.
  template <typename Store>
  void read_list(const pugi::xml_node list, Store store) {
    int id = 0;
    for (const pugi::xml_node item : list.children("item")) {
      const double value = number(item);
      const auto laser = std::find_if(file_.lasers.begin(), file_.lasers.end(),
                                      [id](const LaserEntry& entry) { return entry.id == id; });
      if (laser != file_.lasers.end()) store(*laser, value);
      ++id;
    }
  }

  double number(const pugi::xml_node node) const {
    const std::optional<double> value = parse_number(node.child_value());
    if (!value)
      throw Error(at_line(file_.name, line_at(node.offset_debug())),
                  std::string(node.name()) + " is " + in_quotes(node.child_value()) + ", not a number");
    return *value;
  }

  int line_at(std::ptrdiff_t offset) const {
    const std::size_t end =
        std::min(text_.size(), static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, offset)));
    return 1 + static_cast<int>(
                   std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
  }

  std::string_view text_;
  CalibrationFile file_;
  pugi::xml_document document_;
};

}  // namespace

CalibrationFile read_db_xml(const std::string& name, std::string_view text) {
  return XmlReader(name, text).read();
}

}  // namespace pago::hdl64
