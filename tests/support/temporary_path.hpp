// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

namespace pago::test {

/// A file or folder name that nothing else uses; whatever is made there is removed at the end.
class TemporaryPath {
 public:
  explicit TemporaryPath(const std::string& suffix) {
    static int count = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("pago_test_" + std::to_string(::getpid()) + "_" + std::to_string(count++) + suffix);
  }
  ~TemporaryPath() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace pago::test
