// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pago::evaluation {

/// A line of numbers and where it stood. The first number is kept with more digits than a double has: a stamp
/// since 1970 needs them to the nanosecond.
struct NumberRow {
  std::size_t line = 0;
  std::vector<double> numbers;
  long double first = 0.0L;
};

std::string read_text(const std::filesystem::path& file);

/// Lines of blank-separated numbers; blank lines and # comments are skipped. Error with name:line for a word
/// that is not a finite number.
std::vector<NumberRow> parse_number_rows(std::string_view text, const std::string& name);

/// The row's first number, seconds, as nanoseconds. Error at `where` when it cannot be seconds.
std::int64_t stamp_ns(const NumberRow& row, const std::string& where);

/// "name:line", the `where` of an Error.
std::string at_line(const std::string& name, std::size_t line);

}  // namespace pago::evaluation
