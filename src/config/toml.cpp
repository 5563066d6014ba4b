// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "toml.hpp"

#include <algorithm>

#include "pago/core/error.hpp"

// The one file that includes toml++ (7 s to compile). Header-only also where a distribution has it compiled:
// so libpago needs no further library at run time.
#undef TOML_SHARED_LIB
#undef TOML_HEADER_ONLY
#define TOML_HEADER_ONLY 1
#include <toml++/impl/preprocessor.h>
// toml++ 3.3 tells the compiler that a table's name begins with a letter of a name, and checks it only
// afterwards: "[;" would be undefined behaviour.
#undef TOML_ASSERT_ASSUME
#define TOML_ASSERT_ASSUME(expression) static_assert(true)
#include <toml++/toml.h>

namespace pago::config {
namespace {

Value array_value(const toml::array& array) {
  std::vector<double> numbers;
  for (const toml::node& element : array) {
    if (!element.is_number()) return OtherValue{"an array of other things than numbers"};
    numbers.push_back(*element.value<double>());
  }
  return numbers;
}

Value node_value(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::boolean:
      return node.as_boolean()->get();
    case toml::node_type::integer:
      return node.as_integer()->get();
    case toml::node_type::floating_point:
      return node.as_floating_point()->get();
    case toml::node_type::string:
      return node.as_string()->get();
    case toml::node_type::array:
      return array_value(*node.as_array());
    case toml::node_type::table:
      return TableValue{};
    default:
      return OtherValue{"a date or time"};
  }
}

struct Placed {
  Entry entry;
  unsigned column;
};

void flatten(const toml::table& table, const std::string& prefix, std::vector<Placed>& out) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    out.push_back({{key, node_value(node), name.source().begin.line}, name.source().begin.column});
    if (node.is_table()) flatten(*node.as_table(), key + ".", out);
  }
}

std::string one_line(std::string_view text) {
  std::string out(text);
  std::ranges::replace(out, '\n', ' ');
  return out;
}

}  // namespace

std::vector<Entry> parse_toml(std::string_view text, const std::string& name) {
  std::vector<Placed> placed;
  try {
    flatten(toml::parse(text, name), "", placed);
  } catch (const toml::parse_error& error) {
    throw Error(name + ":" + std::to_string(error.source().begin.line), one_line(error.description()));
  }
  std::ranges::sort(placed, {}, [](const Placed& p) { return std::pair(p.entry.line, p.column); });

  std::vector<Entry> entries;
  entries.reserve(placed.size());
  for (Placed& p : placed) entries.push_back(std::move(p.entry));
  return entries;
}

Value parse_value(std::string_view text) {
  try {
    const toml::table table = toml::parse("value = " + std::string(text));
    if (table.size() == 1) return node_value(*table.get("value"));
  } catch (const toml::parse_error&) {
    // No TOML, so it is text without quotes.
  }
  return std::string(text);
}

}  // namespace pago::config
