// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Settings: a file's text, after a zero byte words as of --set. Either is refused by Error, or gives settings
// that, printed and read again, are the same.
#include <algorithm>

#include "fuzz/fuzz.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"

using namespace pago;

namespace {

void read(std::string_view text, Config& config) {
  const std::size_t end = std::min(text.find('\0'), text.size());
  apply_toml(config, text.substr(0, end), "fuzz.toml");
  if (end < text.size()) set(config, text.substr(end + 1));
  validate(config);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Config config;
  try {
    read(fuzz::text_of({data, size}), config);
  } catch (const Error&) {
    return 0;
  }
  const std::string printed = dump_toml(config);
  Config again;
  apply_toml(again, printed, "printed.toml");
  fuzz::require(dump_toml(again) == printed);
  return 0;
}
