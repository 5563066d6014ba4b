// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/load.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "messages.hpp"
#include "support/catch.hpp"

namespace pago {
namespace {

using test::complaint_of;

std::string complaint_about(std::string_view toml) {
  return complaint_of([&] {
    Config config;
    apply_toml(config, toml, "f.toml");
  });
}

std::string complaint_about_set(std::string_view assignment) {
  return complaint_of([&] {
    Config config;
    set(config, assignment);
  });
}

struct TemporaryFile {
  std::filesystem::path path =
      std::filesystem::temp_directory_path() / ("pago_config_test_" + std::to_string(::getpid()) + ".toml");
  explicit TemporaryFile(std::string_view text) { std::ofstream(path) << text; }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

TEST_CASE("a file changes the settings that it names and no others", "[config][load]") {
  const TemporaryFile file("[mount]\nheight_m = 2  # a whole number will do\n[hdl64]\nmin_range_m = 1.5\n");
  const Config config = load_config(file.path);
  CHECK(config.mount.height_m == 2.0);
  CHECK(config.hdl64.min_range_m == 1.5);

  Config expected;
  expected.mount.height_m = 2.0;
  expected.hdl64.min_range_m = 1.5;
  CHECK(dump_toml(config) == dump_toml(expected));
}

TEST_CASE("every way to write a key is understood", "[config][load]") {
  for (const auto* toml : {"mount.height_m = 2.5", "[mount]\nheight_m = 2.5", "mount = {height_m = 2.5}",
                           "[mount]\r\n\"height_m\" = 2.5\r\n", "\xEF\xBB\xBF[mount]\nheight_m = 25e-1"}) {
    Config config;
    apply_toml(config, toml, "f.toml");
    CHECK(config.mount.height_m == 2.5);
  }
  CHECK(complaint_about("[ground]\n[mount]") == "");
  CHECK(complaint_about("") == "");
}

TEST_CASE("an unknown key or section is refused with its line and the nearest known one", "[config][load]") {
  CHECK(complaint_about("\n[hdl64]\nmin_rang_m = 1") ==
        "f.toml:3: unknown key hdl64.min_rang_m (did you mean hdl64.min_range_m?)");
  CHECK(complaint_about("min_range_m = 1") ==
        "f.toml:1: unknown key min_range_m (did you mean hdl64.min_range_m?)");
  CHECK(complaint_about("[gorund]\nmethod = \"lego\"") ==
        "f.toml:1: unknown section gorund (did you mean ground?)");
  CHECK(complaint_about("[hdl64.calibration.x]") == "f.toml:1: hdl64.calibration must be text, is a table");
  CHECK(complaint_about("zzzzzzzzzz = 1") == "f.toml:1: unknown key zzzzzzzzzz");
}

TEST_CASE("a table without a name is refused, whatever stands in its place", "[config][load]") {
  for (const auto* toml : {"[;", "[;]\nx = 1", "[=]", "[[;]]", "[\x01", "x.;=1"})
    CHECK(complaint_about(toml).starts_with("f.toml:1: "));
}

TEST_CASE("a value of the wrong type is refused with what it must be", "[config][load]") {
  CHECK(complaint_about("hdl64.min_range_m = \"far\"") ==
        "f.toml:1: hdl64.min_range_m must be a number from 0 to 10, is \"far\"");
  CHECK(complaint_about("hdl64.min_range_m = true") ==
        "f.toml:1: hdl64.min_range_m must be a number from 0 to 10, is true");
  CHECK(complaint_about("hdl64.min_range_m = 1979-05-27") ==
        "f.toml:1: hdl64.min_range_m must be a number from 0 to 10, is a date or time");
  CHECK(complaint_about("hdl64.min_range_m = [1, 2]") ==
        "f.toml:1: hdl64.min_range_m must be a number from 0 to 10, is [1.0, 2.0]");
  CHECK(complaint_about("hdl64.calibration = 5") == "f.toml:1: hdl64.calibration must be text, is 5");
  CHECK(complaint_about("hdl64.vertical_offset = \"up\"") ==
        "f.toml:1: hdl64.vertical_offset must be one of \"vertical\", \"perpendicular\", is \"up\"");
  CHECK(complaint_about("mount = 3") == "f.toml:1: mount is a section, not a setting (write [mount])");
  CHECK(complaint_about("[[mount]]\nheight_m = 2") ==
        "f.toml:1: mount is a section, not a setting (write [mount])");
}

TEST_CASE("a number out of range or not finite is refused with the range", "[config][load]") {
  const std::string must_be = "f.toml:2: mount.height_m must be a number from 0.1 to 10, is ";
  CHECK(complaint_about("[mount]\nheight_m = -3") == must_be + "-3");
  CHECK(complaint_about("[mount]\nheight_m = 10.000001") == must_be + "10.000001");
  CHECK(complaint_about("[mount]\nheight_m = nan") == must_be + "nan");
  CHECK(complaint_about("[mount]\nheight_m = -inf") == must_be + "-inf");
  CHECK(complaint_about("[mount]\nheight_m = 1e300") == must_be + "1e+300");
  CHECK(complaint_about("[mount]\nheight_m = 10") == "");
  CHECK(complaint_about("[mount]\nheight_m = 0.1") == "");
}

TEST_CASE("text that is no TOML is refused with the line", "[config][load]") {
  for (const auto* toml : {"[mount]\nheight_m = ", "[mount]\nheight_m 2", "[mount]\n[", "[mount]\n[mount]",
                           "a = 1\na = 2", "[mount]\nheight_m = 2 3", "x = 1\n\x01"}) {
    const std::string complaint = complaint_about(toml);
    CAPTURE(toml, complaint);
    CHECK(complaint.starts_with("f.toml:2: "));
    CHECK(complaint.find('\n') == std::string::npos);
  }
}

TEST_CASE("a file that cannot be read is named with the reason", "[config][load]") {
  CHECK(complaint_of([] { load_config("no/such.toml"); }) ==
        "no/such.toml: cannot be read: No such file or directory");
  const auto folder = std::filesystem::temp_directory_path();
  CHECK(complaint_of([&] { load_config(folder); }) == folder.string() + ": is a folder, not a TOML file");
}

TEST_CASE("a refused text leaves the configuration as it was", "[config][load]") {
  Config config;
  CHECK_THROWS_AS(apply_toml(config, "mount.height_m = 2.0\nhdl64.min_range_m = -1", "f.toml"), Error);
  CHECK(dump_toml(config) == dump_toml({}));
}

TEST_CASE("one setting is changed by key=value, text with or without quotes", "[config][load]") {
  Config config;
  set(config, "mount.height_m=2");
  CHECK(config.mount.height_m == 2.0);
  set(config, "hdl64.vertical_offset=perpendicular");
  CHECK(config.hdl64.vertical_offset == VerticalOffset::kPerpendicular);
  set(config, " hdl64.vertical_offset = \"vertical\" ");
  CHECK(config.hdl64.vertical_offset == VerticalOffset::kVertical);
  set(config, "hdl64.calibration=some folder/a=b #1.xml");
  CHECK(config.hdl64.calibration == "some folder/a=b #1.xml");
  set(config, "hdl64.calibration=64");
  CHECK(config.hdl64.calibration == "64");
  set(config, "hdl64.calibration='a\\b'");
  CHECK(config.hdl64.calibration == "a\\b");
  set(config, "hdl64.calibration=");
  CHECK(config.hdl64.calibration.empty());
}

TEST_CASE("a wrong key=value is refused in one line", "[config][load]") {
  CHECK(complaint_about_set("mount.height_m") == "mount.height_m: is not of the form key=value");
  CHECK(complaint_about_set("mount.heigth_m=2") ==
        "mount.heigth_m=2: unknown key mount.heigth_m (did you mean mount.height_m?)");
  CHECK(complaint_about_set("mount.height_m=tall") ==
        "mount.height_m=tall: mount.height_m must be a number from 0.1 to 10, is \"tall\"");
  CHECK(complaint_about_set("mount.height_m=") ==
        "mount.height_m=: mount.height_m must be a number from 0.1 to 10, is \"\"");
  CHECK(complaint_about_set("mount=1") == "mount=1: mount is a section, not a setting (write [mount])");
  CHECK(complaint_about_set("mount.height_m=2\nhdl64.min_range_m=3").find("must be a number") !=
        std::string::npos);
}

}  // namespace
}  // namespace pago
