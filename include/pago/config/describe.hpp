// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string_view>
#include <utility>

/// How a module declares its settings: a plain struct with defaults, and one function
///
///   template <typename Visitor> void describe(Visitor& v, FooConfig& c) {
///     v("range_m", c.range_m, within(1.0, 120.0), "returns farther away are ignored");
///     v("levelled", c.levelled, "whether ...");                                          // bool
///     v("mode", c.mode, choices(std::pair{"fast", Mode::kFast}, ...), "what ...");        // enum
///     v.section("bins", c.bins, "how ...");                                              // nested struct
///   }
///
/// that names each field's key, valid range and meaning once. Reading TOML, `--set key=value`, refusing
/// unknown keys, printing the configuration and its documentation are visitors over these lists
/// (config/load.hpp). Field types: bool, int, double, std::string, enums, std::array<double, N>.
namespace pago {

/// Bounds of a number, both included.
struct Within {
  double min, max;
};
constexpr Within within(double min, double max) {
  return {min, max};
}

/// The words for an enum's values.
template <typename Enum, std::size_t N>
struct Choices {
  std::array<std::pair<std::string_view, Enum>, N> words;
};
template <typename Enum, typename... Rest>
constexpr auto choices(std::pair<const char*, Enum> first, Rest... rest) {
  return Choices<Enum, 1 + sizeof...(Rest)>{{std::pair<std::string_view, Enum>{first.first, first.second},
                                             std::pair<std::string_view, Enum>{rest.first, rest.second}...}};
}

}  // namespace pago
