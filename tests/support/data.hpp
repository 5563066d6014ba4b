// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <string>

namespace pago::test {

/// Real recordings live outside the repository (their licences forbid copies), in the folder $PAGO_DATA.
inline std::filesystem::path data_folder() {
  const char* folder = std::getenv("PAGO_DATA");
  return folder == nullptr ? std::filesystem::path{} : std::filesystem::path{folder};
}

}  // namespace pago::test

/// Declares `name` as the path of a recording, or ends the test case and says that it was skipped.
#define PAGO_DATA_OR_SKIP(name, relative)                                          \
  const std::filesystem::path name = pago::test::data_folder() / (relative);       \
  if (pago::test::data_folder().empty() || !std::filesystem::exists(name)) {       \
    std::cout << "skipped: needs " << (relative) << " in $PAGO_DATA" << std::endl; \
    SUCCEED("skipped");                                                            \
    return;                                                                        \
  }
