// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <stdexcept>
#include <string>

#include "pago/core/text.hpp"

namespace pago::claims {

/// Prints the lines of a claim as tests/claims/run reads them: claim | figure | bound | ok or FAIL. A figure
/// that is NaN keeps no bound. Units bring their blank along: " m".
class Report {
 public:
  void at_most(const std::string& claim, double figure, double bound, const std::string& unit) {
    line(claim, format("%.4f", figure) + unit, format("<= %g", bound) + unit, figure <= bound);
  }
  void below(const std::string& claim, double figure, double bound, const std::string& unit) {
    line(claim, format("%.4f", figure) + unit, format("< %g", bound) + unit, figure < bound);
  }
  void at_least(const std::string& claim, double figure, double bound, const std::string& unit) {
    line(claim, format("%.4f", figure) + unit, format(">= %g", bound) + unit, figure >= bound);
  }
  void exactly(const std::string& claim, std::uint64_t figure, std::uint64_t bound) {
    line(claim, std::to_string(figure), std::to_string(bound), figure == bound);
  }
  /// A figure that is only to be shown.
  void shown(const std::string& claim, const std::string& figure) { line(claim, figure, "printed", true); }
  void failed(const std::string& claim, const std::string& why) { line(claim, "not measured", why, false); }

  int exit_code() const { return all_hold_ ? 0 : 1; }

 private:
  void line(const std::string& claim, const std::string& figure, const std::string& bound, bool holds) {
    all_hold_ = all_hold_ && holds;
    std::printf("%-70s | %24s | %-26s | %s\n", claim.c_str(), figure.c_str(), bound.c_str(),
                holds ? "ok" : "FAIL");
    std::fflush(stdout);
  }
  bool all_hold_ = true;
};

/// A file or folder of the recordings; throws if it is not there.
inline std::filesystem::path recording(const std::string& relative) {
  const char* data = std::getenv("PAGO_DATA");
  const std::filesystem::path path = std::filesystem::path(data == nullptr ? "" : data) / relative;
  if (data == nullptr || !std::filesystem::exists(path))
    throw std::runtime_error("no " + relative + " in $PAGO_DATA");
  return path;
}

/// Measures, and makes a failed line of whatever keeps it from it. For main() to return.
template <typename Measure>
int run(const std::string& claim, Measure measure) {
  Report report;
  try {
    measure(report);
  } catch (const std::exception& error) {
    report.failed(claim, error.what());
  }
  return report.exit_code();
}

}  // namespace pago::claims
