// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "settings.hpp"

namespace pago::config {

/// One key of a TOML text.
struct Entry {
  std::string key;  ///< from the top: "ground.method"
  Value value;
  unsigned line;  ///< from 1
};

/// Every table and every value of the text, in order of appearance. Throws Error with `name` and line.
std::vector<Entry> parse_toml(std::string_view text, const std::string& name);

/// What the right-hand side of a TOML assignment means; text that is none is taken as it stands.
Value parse_value(std::string_view text);

}  // namespace pago::config
