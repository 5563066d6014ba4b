// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/csv.hpp"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "pago/core/error.hpp"

namespace pago {
namespace {

std::vector<std::string> cells_of(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  std::vector<std::string> cells;
  while (true) {
    const std::size_t length = std::min(line.find(','), line.size());
    cells.emplace_back(line.substr(0, length));
    if (length == line.size()) return cells;
    line.remove_prefix(length + 1);
  }
}

}  // namespace

CsvTable CsvTable::read(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file))
    throw Error(file.string(), "cannot be opened", "does it exist, may it be read?");
  return parse(std::string{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()},
               file.string());
}

CsvTable CsvTable::parse(std::string_view text, std::string name) {
  CsvTable table;
  table.name_ = std::move(name);
  while (!text.empty()) {
    const std::size_t length = text.find('\n');
    if (length == std::string_view::npos) break;
    std::vector<std::string> cells = cells_of(text.substr(0, length));
    text.remove_prefix(length + 1);
    if (table.columns_.empty()) {
      table.columns_ = std::move(cells);
      continue;
    }
    if (cells.size() != table.columns_.size())
      throw Error(table.name_ + ":" + std::to_string(table.rows_.size() + 2),
                  "has " + std::to_string(cells.size()) + " cells, the first line " +
                      std::to_string(table.columns_.size()));
    table.rows_.push_back(std::move(cells));
  }
  if (table.columns_.empty()) throw Error(table.name_, "has no line with the names of its columns");
  return table;
}

std::optional<std::size_t> CsvTable::find(std::string_view column) const noexcept {
  const auto found = std::find(columns_.begin(), columns_.end(), column);
  if (found == columns_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - columns_.begin());
}

std::size_t CsvTable::at(std::string_view column) const {
  if (const auto index = find(column)) return *index;
  throw Error(name_, "has no column \"" + std::string(column) + "\"");
}

template <typename Number>
Number CsvTable::parsed(std::size_t row, std::size_t column) const {
  const std::string& cell = rows_[row][column];
  Number value{};
  const char* const end = cell.data() + cell.size();
  const auto [stop, fault] = std::from_chars(cell.data(), end, value);
  if (fault != std::errc{} || stop != end)
    throw Error(name_ + ":" + std::to_string(row + 2),
                columns_[column] + " is \"" + cell.substr(0, 40) + "\", not a number");
  return value;
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  return parsed<double>(row, column);
}
std::int64_t CsvTable::integer(std::size_t row, std::size_t column) const {
  return parsed<std::int64_t>(row, column);
}
std::uint64_t CsvTable::count(std::size_t row, std::size_t column) const {
  return parsed<std::uint64_t>(row, column);
}

}  // namespace pago
