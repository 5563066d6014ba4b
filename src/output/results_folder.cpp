// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/results_folder.hpp"

#include <unistd.h>

#include <array>
#include <ctime>

#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {
namespace {

namespace fs = std::filesystem;

constexpr int kMostRunsPerSecond = 1000;

std::string local_time(std::chrono::system_clock::time_point now) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(now);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d_%H-%M-%S", &parts);
  return text.data();
}

/// create_directory tells whether it was this call that made the folder: the one test that cannot race.
fs::path make_unique(const fs::path& parent, const std::string& name) {
  for (int run = 1; run <= kMostRunsPerSecond; ++run) {
    fs::path folder = parent / (run == 1 ? name : name + "_" + std::to_string(run));
    std::error_code fault;
    if (fs::create_directory(folder, fault)) return folder;
    if (fault && fault != std::errc::file_exists)
      throw Error(folder.string(), "the folder cannot be made: " + fault.message(),
                  "choose another with --output");
  }
  throw Error((parent / name).string(), "and all its numbered successors exist");
}

/// A link under another name, moved into place: whoever follows `latest` finds the old run or the new one.
std::string set_link(const fs::path& link, const fs::path& target) {
  std::error_code fault;
  if (fs::exists(fs::symlink_status(link, fault)) && !fs::is_symlink(fs::symlink_status(link, fault)))
    return link.string() + ": is not a link and was left as it is";
  const fs::path fresh = link.parent_path() / (".latest_" + std::to_string(::getpid()));
  fs::remove(fresh, fault);
  fs::create_symlink(target, fresh, fault);
  if (!fault) fs::rename(fresh, link, fault);
  return fault ? link.string() + ": cannot be set: " + fault.message() : "";
}

}  // namespace

ResultsFolder create_results_folder(const fs::path& parent, std::chrono::system_clock::time_point now) {
  make_folders(parent);
  ResultsFolder results;
  results.folder = make_unique(parent, local_time(now));
  results.latest = parent / "latest";
  results.complaint = set_link(results.latest, results.folder.filename());
  return results;
}

}  // namespace pago::output
