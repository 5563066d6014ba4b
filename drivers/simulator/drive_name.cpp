// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/drive_name.hpp"

#include <string>

#include "pago/config/load.hpp"

namespace pago::simulator {

void apply_drive_name(Config& config, std::string_view name) {
  bool is_first = true;
  while (is_first || !name.empty()) {
    const std::size_t comma = std::min(name.find(','), name.size());
    const std::string word(name.substr(0, comma));
    name.remove_prefix(std::min(comma + 1, name.size()));
    set(config, (is_first ? "simulator.world=" : "simulator.") + word);
    is_first = false;
  }
}

}  // namespace pago::simulator
