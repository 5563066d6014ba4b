// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <embree3/rtcore_config.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <system_error>
#include <vector>

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
  relevant.simulator.path.clear();
  relevant.mount = config.mount;
  relevant.hdl64.vertical_offset = config.hdl64.vertical_offset;
  relevant.hdl64.packet_stamp = config.hdl64.packet_stamp;
  return std::string(kSourcesDigest) + "Embree " RTC_VERSION_STRING "\n" + dump_toml(relevant) +
         digest(contents(config.hdl64.calibration)) + digest(contents(config.simulator.path));
}

void remove_quietly(const fs::path& folder) {
  std::error_code ignored;
  fs::remove_all(folder, ignored);
}

bool is_complete(const fs::path& folder) {
  const DriveFiles files = files_in(folder);
  const fs::path all[] = {files.pcap, files.labels, files.calibration, files.truth};
  return std::ranges::all_of(all, [](const fs::path& file) { return fs::exists(file); });
}

/// Drives of processes that were killed while they rendered: DIGEST.PROCESS.
void remove_abandoned(const fs::path& cache) {
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(cache, fault)) {
    const std::string extension = entry.path().extension().string();
    const int process = extension.empty() ? 0 : std::atoi(extension.c_str() + 1);
    if (process > 0 && kill(process, 0) != 0 && errno == ESRCH) remove_quietly(entry.path());
  }
}

std::uintmax_t size_of(const fs::path& folder) {
  std::uintmax_t bytes = 0;
  std::error_code fault;
  for (const fs::directory_entry& file : fs::directory_iterator(folder, fault)) {
    const std::uintmax_t size = file.file_size(fault);
    if (!fault) bytes += size;
  }
  return bytes;
}

/// Drives that have not been used for the longest time go, until the rest has room.
void prune(const fs::path& cache, std::uintmax_t most_bytes) {
  struct Drive {
    fs::file_time_type used;
    std::uintmax_t bytes;
    fs::path folder;
  };
  std::vector<Drive> drives;
  std::uintmax_t total = 0;
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(cache, fault)) {
    if (entry.path().has_extension() || !is_complete(entry.path())) continue;
    drives.push_back({fs::last_write_time(entry.path(), fault), size_of(entry.path()), entry.path()});
    total += drives.back().bytes;
  }
  std::ranges::sort(drives, {}, &Drive::used);
  for (const Drive& drive : drives) {
    if (total <= most_bytes) return;
    remove_quietly(drive.folder);
    total -= drive.bytes;
  }
}

}  // namespace

fs::path cached_drive(const Config& config,
                      const fs::path& cache,
                      const std::function<void(const Progress&)>& on_progress,
                      const std::atomic<bool>& stop,
                      std::uintmax_t most_bytes) {
  const std::string text = recipe(config);
  const fs::path folder = cache / digest(text);
  std::error_code ignored;
  if (is_complete(folder)) {
    fs::last_write_time(folder, fs::file_time_type::clock::now(), ignored);
    return folder;
  }
  remove_quietly(folder);
  remove_abandoned(cache);
  prune(cache, most_bytes);
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
  const bool is_stopped = stop.load(std::memory_order_relaxed);
  if (!is_stopped) fs::rename(unfinished, folder, fault);
  // Another process may have been faster; its drive is the same.
  if (is_stopped || fault) remove_quietly(unfinished);
  if (is_stopped) throw std::runtime_error("stopped by a signal: the drive is not rendered");
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
