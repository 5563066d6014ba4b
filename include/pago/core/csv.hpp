// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pago {

/// A table as PaGO writes them: names of the columns in the first line, cells without quotes or commas
/// inside. [set-up] everything here allocates and throws Error with file:line.
class CsvTable {
 public:
  /// A last line without line feed is left out: the run that wrote it was cut off. Error when the file cannot
  /// be read, has no first line, or a line has another number of cells than the first.
  static CsvTable read(const std::filesystem::path& file);
  /// The same from text; `name` stands for the file in messages.
  static CsvTable parse(std::string_view text, std::string name);

  std::size_t num_rows() const noexcept { return rows_.size(); }
  const std::string& name() const noexcept { return name_; }

  /// Index of a column by its name; empty when there is none.
  std::optional<std::size_t> find(std::string_view column) const noexcept;
  /// The same; Error that names the file when there is none.
  std::size_t at(std::string_view column) const;

  const std::string& text(std::size_t row, std::size_t column) const { return rows_[row][column]; }
  /// Error when the cell is not a number of the kind, all of it.
  double number(std::size_t row, std::size_t column) const;
  std::int64_t integer(std::size_t row, std::size_t column) const;
  std::uint64_t count(std::size_t row, std::size_t column) const;

 private:
  template <typename Number>
  Number parsed(std::size_t row, std::size_t column) const;

  std::string name_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace pago
