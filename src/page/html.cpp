// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/page/html.hpp"

#include <algorithm>
#include <cmath>

#include "pago/core/text.hpp"
#include "style.hpp"

namespace pago::page {
namespace {

/// Bytes of the UTF-8 sequence at the start of the text; 0 when it is none.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  const std::size_t length = first < 0x80          ? 1
                             : first >> 5U == 0x6  ? 2
                             : first >> 4U == 0xE  ? 3
                             : first >> 3U == 0x1E ? 4
                                                   : 0;
  if (length == 0 || length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if (byte(i) >> 6U != 0x2) return 0;
  return length;
}

std::string element(const char* name, std::string_view text) {
  return std::string("<").append(name).append(">").append(escape(text)).append("</").append(name).append(">");
}

std::string html_of(const Cell& cell) {
  std::string html = cell.is_best ? "<td class=\"best\">" : "<td>";
  html += escape(cell.text);
  if (cell.note.empty()) return html + "</td>";
  const char* const tone = cell.tone == Tone::kGood  ? " class=\"good\""
                           : cell.tone == Tone::kBad ? " class=\"bad\""
                                                     : "";
  return html + "<small" + tone + ">" + escape(cell.note) + "</small></td>";
}

int decimals_for(double value) {
  const double size = std::abs(value);
  if (size >= 1000.0) return 0;
  if (size >= 100.0) return 1;
  if (size >= 10.0) return 2;
  return size >= 1.0 ? 3 : 4;
}

}  // namespace

std::string escape(std::string_view text) {
  std::string html;
  while (!text.empty()) {
    const std::size_t length = utf8_length(text);
    switch (length == 1 ? text.front() : 'a') {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\'':
        html += "&#39;";
        break;
      default:
        html += length == 0 ? std::string_view("\xEF\xBF\xBD") : text.substr(0, length);
    }
    text.remove_prefix(std::max<std::size_t>(1, length));
  }
  return html;
}

std::string document(const Document& page) {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n" +
         element("title", page.title) + "\n<style>" + std::string(style()) + "</style>\n</head>\n<body>\n" +
         element("h1", page.title) + "\n<p class=\"lead\">" + escape(page.lead) + "</p>\n" + page.html +
         "\n<footer>" + escape(page.footer) + "</footer>\n<script>" + std::string(script()) +
         "</script>\n</body>\n</html>\n";
}

std::string section(std::string_view title, std::string_view text, std::string_view html) {
  return "<section>" + element("h2", title) + (text.empty() ? std::string() : paragraph(text)) +
         std::string(html) + "</section>\n";
}

std::string grid(std::string_view html) {
  return "<div class=\"grid\">" + std::string(html) + "</div>\n";
}

std::string paragraph(std::string_view text) {
  return element("p", text) + "\n";
}

std::string notice(std::string_view title, std::string_view text) {
  return "<div class=\"notice\">" + element("b", title) + element("p", text) + "</div>\n";
}

std::string details(std::string_view title, std::string_view html) {
  return "<details>" + element("summary", title) + std::string(html) + "</details>\n";
}

std::string tiles(const std::vector<Tile>& tiles) {
  std::string html = "<div class=\"tiles\">";
  for (const Tile& tile : tiles)
    html += "<div class=\"tile\">" + escape(tile.name) + "<b>" + escape(tile.value) +
            element("span", tile.unit) + "</b>" +
            (tile.note.empty() ? std::string() : element("small", tile.note)) + "</div>";
  return html + "</div>\n";
}

std::string table(const Table& table) {
  std::string html = "<div class=\"scroll\"><table><thead><tr>";
  for (const std::string& name : table.head) html += element("th", name);
  html += "</tr></thead><tbody>\n";
  for (const std::vector<Cell>& row : table.rows) {
    html += "<tr>";
    for (const Cell& cell : row) html += html_of(cell);
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string number(double value) {
  return std::isfinite(value) ? format("%.*f", decimals_for(value), value) : "–";
}

std::string difference(double value) {
  return std::isfinite(value) ? format("%+.*f", decimals_for(value), value) : "–";
}

}  // namespace pago::page
