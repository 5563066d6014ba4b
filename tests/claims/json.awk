# SPDX-FileCopyrightText: 2026 The PaGO authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Prints every number, word and string of a JSON file in a line of its own: names and indices that lead to it, joined by
# dots, a tab, and the value, strings without their quotes (packets.bad.size<TAB>0).
{ text = text $0 "\n" }

function path(    i, joined) {
  joined = name[1]
  for (i = 2; i <= depth; ++i) joined = joined "." name[i]
  return joined
}
function unquoted(word) { return word ~ /^"/ ? substr(word, 2, length(word) - 2) : word }

END {
  depth = 0
  while (match(text, /"([^"\\]|\\.)*"|[][{}:,]|[^][{}:," \t\r\n]+/)) {
    token = substr(text, RSTART, RLENGTH)
    text = substr(text, RSTART + RLENGTH)
    if (token == "{" || token == "[") {
      kind[++depth] = token
      name[depth] = token == "[" ? 0 : ""
      is_value = token == "["
    } else if (token == "}" || token == "]") {
      --depth
    } else if (token == ":") {
      is_value = 1
    } else if (token == ",") {
      if (kind[depth] == "[") ++name[depth]
      is_value = kind[depth] == "["
    } else if (is_value) {
      print path() "\t" unquoted(token)
    } else {
      name[depth] = unquoted(token)
    }
  }
}
