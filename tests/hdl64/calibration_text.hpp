// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "pago/core/units.hpp"
#include "pago/hdl64/calibration.hpp"
#include "support/temporary_path.hpp"

namespace pago::test {

inline std::string read_text(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

/// A file with this content, gone when the test ends.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& content) { std::ofstream(path(), std::ios::binary) << content; }
  const std::filesystem::path& path() const { return path_.path(); }

 private:
  TemporaryPath path_{"_calibration"};
};

inline hdl64::Calibration load_text(const std::string& content) {
  const TemporaryFile file(content);
  return hdl64::load_calibration(file.path(), VerticalOffset::kVertical);
}

/// One line per laser, `lasers:` is line 1 and laser i is line i + 2.
struct YamlLaser {
  std::string rot = "0.01", vert, dist = "1.2", rest = "vert_offset_correction: 0.2";
};
inline std::vector<YamlLaser> yaml_lasers(int count = 64,
                                          double lowest_deg = -24.8,
                                          double highest_deg = 2.0) {
  std::vector<YamlLaser> lasers(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    lasers[static_cast<std::size_t>(i)].vert =
        std::to_string((highest_deg + (lowest_deg - highest_deg) * i / (count - 1)) * kDegree);
  return lasers;
}
inline std::string yaml_text(const std::vector<YamlLaser>& lasers) {
  std::ostringstream text;
  text << "lasers:\n";
  for (std::size_t i = 0; i < lasers.size(); ++i)
    text << "- {laser_id: " << i << ", rot_correction: " << lasers[i].rot
         << ", vert_correction: " << lasers[i].vert << ", dist_correction: " << lasers[i].dist << ", "
         << lasers[i].rest << "}\n";
  return text.str();
}

/// A db.xml with 64 lasers, of which `enabled` are switched on.
inline std::string xml_text(int enabled, double lowest_deg, double highest_deg) {
  std::ostringstream text;
  text << "<boost_serialization><DB><enabled_><count>64</count>";
  for (int i = 0; i < 64; ++i) text << "<item>" << (i < enabled) << "</item>";
  text << "</enabled_><points_>";
  for (int i = 0; i < 64; ++i) {
    const int step = std::min(i, enabled - 1);
    text << "<item><px><id_>" << i << "</id_><rotCorrection_> 1.5</rotCorrection_><vertCorrection_>"
         << highest_deg + (lowest_deg - highest_deg) * step / (enabled - 1)
         << "</vertCorrection_><distCorrection_>120</distCorrection_></px></item>\n";
  }
  text << "</points_></DB></boost_serialization>";
  return text.str();
}

}  // namespace pago::test
