// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include "pago/config/load.hpp"
#include "pago/core/error.hpp"

int main(int argc, char** argv) try {
  const pago::Config config = argc > 1 ? pago::load_config(argv[1]) : pago::Config{};
  std::cout << pago::dump_toml(config);
  return 0;
} catch (const pago::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
