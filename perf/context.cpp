// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "context.hpp"

#include <sys/utsname.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <thread>

#include "commit.hpp"

namespace pago::perf {

namespace {

/// The value of the first line of /proc/cpuinfo that begins with `key`.
std::string of_cpu(const std::string& key) {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with(key) && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

std::string machine() {
  const std::string model = of_cpu("model name");
  const bool is_guest = of_cpu("flags").find(" hypervisor") != std::string::npos;
  return (model.empty() ? "unknown CPU" : model) + " x " +
         std::to_string(std::thread::hardware_concurrency()) + (is_guest ? " (virtual)" : "");
}

std::string kernel() {
  utsname name{};
  uname(&name);
  return std::string(name.sysname) + " " + name.release + " " + name.machine;
}

std::string date() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> text{};
  const std::size_t size = std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M UTC", &utc);
  return {text.data(), size};
}

std::string load() {
  double average = 0.0;
  if (getloadavg(&average, 1) != 1) return "load unknown";
  return "load average " + std::to_string(average).substr(0, 4);
}

}  // namespace

std::string context_line() {
  return machine() + ", " + kernel() + ", g++ " + __VERSION__ + ", commit " + kCommit + ", " + date() + ", " +
         load();
}

}  // namespace pago::perf
