// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <fstream>

#include "pago/core/error.hpp"
#include "pago/simulator/render.hpp"
#include "pago/simulator/unit.hpp"
#include "support/catch.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
namespace fs = std::filesystem;

namespace {

Config tiny_drive() {
  Config config;
  config.simulator.seconds = 0.1;
  return config;
}

struct Cache {
  test::TemporaryPath folder{""};
  int rendered = 0;  // counts progress calls

  fs::path get(const Config& config, bool stopped = false) {
    const std::atomic<bool> stop{stopped};
    return simulator::cached_drive(
        config, folder.path(), [this](const Progress&) { ++rendered; }, stop);
  }
  std::size_t entries() const {
    return static_cast<std::size_t>(
        std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator{}));
  }
};

}  // namespace

TEST_CASE("a drive is rendered once, and found again", "[simulator][cache]") {
  Cache cache;
  const fs::path folder = cache.get(tiny_drive());
  CHECK(cache.rendered > 0);
  CHECK(fs::file_size(folder / "packets.pcap") > 400'000);
  CHECK(fs::exists(folder / "packets.labels"));
  CHECK(fs::exists(folder / "calibration.xml"));
  CHECK(fs::exists(folder / "truth.tum"));
  cache.rendered = 0;
  Config same = tiny_drive();
  same.ground.method = "lego";  // has nothing to do with the drive
  CHECK(cache.get(same) == folder);
  CHECK(cache.rendered == 0);
  CHECK(cache.entries() == 1);

  Config other = tiny_drive();
  other.simulator.seed = 2;
  CHECK(cache.get(other) != folder);
  other = tiny_drive();
  other.mount.height_m = 1.9;
  CHECK(cache.get(other) != folder);
}

TEST_CASE("a calibration counts by what is in it", "[simulator][cache]") {
  Cache cache;
  const test::TemporaryPath file(".xml"), copy(".xml");
  std::ofstream(file.path()) << simulator::calibration_xml(simulator::made_up_unit());
  std::ofstream(copy.path()) << simulator::calibration_xml(simulator::made_up_unit());
  Config config = tiny_drive();
  config.hdl64.calibration = file.path().string();
  const fs::path first = cache.get(config);
  config.hdl64.calibration = copy.path().string();
  CHECK(cache.get(config) == first);
  hdl64::Calibration changed = simulator::made_up_unit();
  changed.lasers[3].distance_m += 0.01;
  std::ofstream(copy.path()) << simulator::calibration_xml(changed);
  CHECK(cache.get(config) != first);
}

TEST_CASE("a drive that was stopped leaves nothing behind", "[simulator][cache]") {
  Cache cache;
  REQUIRE_THROWS_AS(cache.get(tiny_drive(), true), std::runtime_error);
  CHECK(cache.entries() == 0);
}

TEST_CASE("a cached drive that files are missing from is rendered anew", "[simulator][cache]") {
  Cache cache;
  const fs::path folder = cache.get(tiny_drive());
  fs::remove(folder / "truth.tum");
  cache.rendered = 0;
  CHECK(cache.get(tiny_drive()) == folder);
  CHECK(cache.rendered > 0);
  CHECK(fs::exists(folder / "truth.tum"));
}

TEST_CASE("the cache lets go of what was used longest ago, and of what killed processes left",
          "[simulator][cache]") {
  Cache cache;
  const auto drive = [&](int seed, std::uintmax_t most_bytes = simulator::kMostCached_bytes) {
    Config config = tiny_drive();
    config.simulator.seed = seed;
    return simulator::cached_drive(
        config, cache.folder.path(), [](const Progress&) {}, std::atomic<bool>{false}, most_bytes);
  };
  const fs::path first = drive(1), second = drive(2);
  fs::last_write_time(second, fs::last_write_time(first) - std::chrono::hours(1));
  fs::create_directory(cache.folder.path() / "0123456789abcdef.99999999");  // no process has this number
  fs::create_directory(cache.folder.path() / ("0123456789abcdef." + std::to_string(getpid())));
  const fs::path third = drive(3, 1'000'000);  // room for one of them
  CHECK(fs::exists(first));
  CHECK(!fs::exists(second));
  CHECK(fs::exists(third));
  CHECK(cache.entries() == 3);
}

TEST_CASE("no two outputs of a drive have one name", "[simulator][cache]") {
  const test::TemporaryPath file(".pcap");
  simulator::DriveFiles files;
  files.pcap = file.path();
  files.labels = file.path().parent_path() / "." / file.path().filename();
  REQUIRE_THROWS_WITH(simulator::render(
                          tiny_drive(), files, [](const Progress&) {}, std::atomic<bool>{false}),
                      Catch::Contains("is named twice"));
}

TEST_CASE("the cache is where the user's caches are", "[simulator][cache]") {
  setenv("XDG_CACHE_HOME", "/somewhere/cache", 1);
  CHECK(simulator::default_cache() == "/somewhere/cache/pago/drives");
  unsetenv("XDG_CACHE_HOME");
  setenv("HOME", "/home/somebody", 1);
  CHECK(simulator::default_cache() == "/home/somebody/.cache/pago/drives");
}
