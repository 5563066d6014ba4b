// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <embree3/rtcore_config.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>

#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/output/text_file.hpp"
#include "pago/simulator/render.hpp"
#include "random.hpp"
#include "simulator_sources.hpp"

namespace pago::simulator {

namespace fs = std::filesystem;

namespace {

/// 128 bits that no two texts share by accident.
std::string digest(std::string_view text) {
  std::uint64_t a = 1, b = 2;
  for (const char letter : text) {
    a = scrambled(a + kGolden + static_cast<unsigned char>(letter));
    b = scrambled(b ^ (kGolden * (1U + static_cast<unsigned char>(letter))));
  }
  return format("%016llx%016llx", static_cast<unsigned long long>(a), static_cast<unsigned long long>(b));
}

std::string contents(const std::string& file) {
  if (file.empty()) return {};
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file, "cannot be opened", "is the path right?");
  return {std::istreambuf_iterator<char>(in), {}};
}

/// All that shapes a drive, as text. Names of files do not.
std::string recipe(const Config& config) {
  Config relevant;
  relevant.simulator = config.simulator;
  relevant.mount = config.mount;
  relevant.hdl64 = config.hdl64;
  relevant.hdl64.calibration.clear();
  relevant.simulator.path.clear();
  return std::string(kSourcesDigest) + "Embree " RTC_VERSION_STRING "\n" + dump_toml(relevant) +
         digest(contents(config.hdl64.calibration)) + digest(contents(config.simulator.path));
}

void remove_quietly(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

}  // namespace

fs::path cached_drive(const Config& config,
                      const fs::path& cache,
                      const std::function<void(const Progress&)>& on_progress,
                      const std::atomic<bool>& stop) {
  const std::string text = recipe(config);
  const fs::path folder = cache / digest(text);
  if (fs::exists(folder)) return folder;
  // Made under another name first: what has the right name is complete.
  const fs::path unfinished = cache / (folder.filename().string() + format(".%d", getpid()));
  output::make_folders(unfinished);
  try {
    output::write_file(unfinished / "settings.txt", text);
    render(config, files_in(unfinished), on_progress, stop);
  } catch (...) {
    remove_quietly(unfinished);
    throw;
  }
  std::error_code fault;
  const bool is_complete = !stop.load(std::memory_order_relaxed);
  if (is_complete) fs::rename(unfinished, folder, fault);
  // Another process may have been faster; its drive is the same.
  if (!is_complete || fault) remove_quietly(unfinished);
  if (!is_complete) throw std::runtime_error("stopped by a signal: the drive is not rendered");
  if (!fs::exists(folder)) throw Error(folder.string(), "cannot be made: " + fault.message());
  return folder;
}

fs::path default_cache() {
  const char* const cache = std::getenv("XDG_CACHE_HOME");
  if (cache != nullptr && *cache != '\0') return fs::path(cache) / "pago" / "drives";
  const char* const home = std::getenv("HOME");
  if (home == nullptr || *home == '\0')
    throw Error("simulator", "no place for rendered drives", "set XDG_CACHE_HOME or HOME");
  return fs::path(home) / ".cache" / "pago" / "drives";
}

}  // namespace pago::simulator
