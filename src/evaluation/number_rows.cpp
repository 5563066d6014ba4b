// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "number_rows.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "pago/core/error.hpp"

namespace pago::evaluation {
namespace {

constexpr std::string_view kBlanks = " \t\r";
// Beyond this a stamp in seconds no longer fits 64 bits of nanoseconds.
constexpr long double kLargestStampSeconds = 9.2e9L;

template <typename Number>
Number parse_number(std::string_view word, const std::string& where) {
  Number value{};
  const char* const begin = word.data() + (word.front() == '+' ? 1 : 0);
  const char* const end = word.data() + word.size();
  const auto [stop, fault] = std::from_chars(begin, end, value);
  if (fault != std::errc{} || stop != end)
    throw Error(where, "\"" + std::string(word.substr(0, 40)) + "\" is not a number");
  if (!std::isfinite(value)) throw Error(where, "\"" + std::string(word) + "\" is not a finite number");
  return value;
}

NumberRow parse_row(std::string_view line, std::size_t number, const std::string& name) {
  NumberRow row;
  row.line = number;
  const std::string where = at_line(name, number);
  while (true) {
    line.remove_prefix(std::min(line.find_first_not_of(kBlanks), line.size()));
    if (line.empty() || line.front() == '#') return row;
    const std::string_view word = line.substr(0, line.find_first_of(kBlanks));
    if (row.numbers.empty()) row.first = parse_number<long double>(word, where);
    row.numbers.push_back(parse_number<double>(word, where));
    line.remove_prefix(word.size());
  }
}

}  // namespace

std::string read_text(const std::filesystem::path& file) {
  if (std::filesystem::is_directory(file)) throw Error(file.string(), "is a folder, not a file");
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(file.string(), "cannot be opened", "does it exist, may it be read?");
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::int64_t stamp_ns(const NumberRow& row, const std::string& where) {
  if (!(std::fabs(row.first) < kLargestStampSeconds))
    throw Error(where, "its stamp is too large for seconds", "stamps are in seconds, not nanoseconds");
  return std::llround(row.first * 1e9L);
}

std::string at_line(const std::string& name, std::size_t line) {
  return name + ":" + std::to_string(line);
}

std::vector<NumberRow> parse_number_rows(std::string_view text, const std::string& name) {
  std::vector<NumberRow> rows;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t length = std::min(text.find('\n'), text.size());
    NumberRow row = parse_row(text.substr(0, length), line, name);
    if (!row.numbers.empty()) rows.push_back(std::move(row));
    text.remove_prefix(std::min(length + 1, text.size()));
  }
  return rows;
}

}  // namespace pago::evaluation
