// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Pages that are one file: style, script and pictures inside, nothing fetched, readable on paper, on a phone
/// and in the dark. The functions give pieces of HTML to be strung together; document() makes a page of them.
/// [set-up] everything here allocates. The same data give the same bytes.
namespace pago::page {

/// Text as HTML: &, <, >, " and ' replaced, and so is what is no UTF-8. Every argument named `text` is
/// plain text that the functions escape themselves; those named `html` are taken as they are.
std::string escape(std::string_view text);

/// The whole page.
struct Document {
  std::string title;   ///< heading, and name of the window
  std::string lead;    ///< plain text below it: what the reader wants to know first
  std::string html;    ///< the pieces
  std::string footer;  ///< plain text: what made it
};
std::string document(const Document& page);

/// A heading with what belongs under it.
std::string section(std::string_view title, std::string_view text, std::string_view html);
/// Figures side by side where there is room for it.
std::string grid(std::string_view html);
std::string paragraph(std::string_view text);
/// A thing that the reader must not miss.
std::string notice(std::string_view title, std::string_view text);
/// Hidden until asked for.
std::string details(std::string_view title, std::string_view html);

/// A number to be seen from afar.
struct Tile {
  std::string name, value, unit;
  std::string note{};  ///< smaller, below
};
std::string tiles(const std::vector<Tile>& tiles);

enum class Tone { kNone, kGood, kBad };
struct Cell {
  std::string text;
  std::string note{};  ///< smaller, behind it: a difference
  Tone tone = Tone::kNone;
  bool is_best = false;
};
/// Cells of the first column are names, the rest numbers.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<Cell>> rows;
};
std::string table(const Table& table);

/// Decimals that show four significant digits, but at least one and at most four; "–" when not finite.
std::string number(double value);
/// The same with its sign.
std::string difference(double value);

}  // namespace pago::page
