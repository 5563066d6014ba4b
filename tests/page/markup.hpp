// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pago::test {

inline std::size_t times(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

/// The first tag that does not fit those before it, "" when all are closed in their order. What is between
/// the tags of script and style is passed over.
inline std::string misplaced_tag(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at + 1)) {
    const std::size_t end = html.find('>', at);
    if (end == std::string::npos) return html.substr(at, 40);
    const std::string tag = html.substr(at + 1, end - at - 1);
    at = end;
    if (tag.starts_with("!") || tag.ends_with("/")) continue;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1)) return "<" + tag + ">";
      open.pop_back();
      continue;
    }
    open.push_back(tag.substr(0, tag.find(' ')));
    if (open.back() == "script" || open.back() == "style") at = html.find("</" + open.back(), at) - 1;
  }
  return open.empty() ? "" : open.back() + " stays open";
}

/// Whether the page would fetch something.
inline bool fetches(const std::string& html) {
  for (const char* sign : {"http:", "https:", "src=", "href=", "url(", "@import", "fetch(", "//cdn"})
    if (html.find(sign) != std::string::npos) return true;
  return false;
}

}  // namespace pago::test
