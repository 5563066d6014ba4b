// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>

namespace pago::app {

/// What a live run has to say while it runs: on the terminal (standard error) and in the run's log.txt, which
/// is begun anew when it grows large; the last three are kept. [publisher thread]
class Log {
 public:
  /// [set-up] Throws Error if the file cannot be made.
  explicit Log(const std::filesystem::path& folder);
  ~Log();

  void info(const std::string& text);
  void warn(const std::string& text);
  void flush();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago::app
