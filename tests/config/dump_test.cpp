// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "pago/config/load.hpp"
#include "src/config/settings.hpp"
#include "support/catch.hpp"

namespace pago {
namespace {

using config::Setting;
using config::Settings;
using config::Value;

class RandomValues {
 public:
  explicit RandomValues(unsigned seed) : bits_(seed) {}

  Value operator()(const Setting& setting) {
    if (const auto* word = std::get_if<config::WordSlot>(&setting.slot))
      return std::string(word->words[bits_() % word->words.size()]);
    if (std::holds_alternative<bool*>(setting.slot)) return bits_() % 2 == 0;
    if (std::holds_alternative<std::string*>(setting.slot)) return text();
    if (std::holds_alternative<int*>(setting.slot))
      return static_cast<std::int64_t>(
          std::floor(number({std::ceil(setting.bounds.min), setting.bounds.max})));
    if (std::holds_alternative<double*>(setting.slot)) return number(setting.bounds);
    std::vector<double> numbers(std::get<std::span<double>>(setting.slot).size());
    std::ranges::generate(numbers, [&] { return number(setting.bounds); });
    return numbers;
  }

 private:
  double number(Within bounds) {
    constexpr double kLargest = 1e9;
    return std::uniform_real_distribution(std::max(bounds.min, -kLargest),
                                          std::min(bounds.max, kLargest))(bits_);
  }
  std::string text() {
    static const std::vector<std::string> kParts{"a", "\"", "\\",     "\n", "\t",  "'",
                                                 "#", "=",  "\u00e4", " ",  "\x7f"};
    std::string out;
    for (unsigned n = static_cast<unsigned>(bits_() % 9); n > 0; --n) out += kParts[bits_() % kParts.size()];
    return out;
  }

  std::mt19937_64 bits_;
};

TEST_CASE("a dumped configuration loads as the same configuration", "[config][dump]") {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Config config;
    RandomValues random(seed);
    const Settings settings = config::settings_of(config);
    for (const Setting& setting : settings.list) {
      CAPTURE(seed, setting.key);
      REQUIRE(assign(setting, random(setting)));
    }
    Config loaded;
    apply_toml(loaded, dump_toml(config), "dump");
    REQUIRE(dump_toml(loaded) == dump_toml(config));
    const Settings back = config::settings_of(loaded);
    for (std::size_t i = 0; i < back.list.size(); ++i)
      REQUIRE(to_text(value_of(back.list[i])) == to_text(value_of(settings.list[i])));
  }
}

TEST_CASE("a dump shows each setting under its meaning, its bounds and its default", "[config][dump]") {
  Config config;
  config.mount.height_m = 2.0;
  const std::string dump = dump_toml(config);
  CHECK(dump.find("\n# how the sensor sits on the vehicle\n[mount]\n"
                  "# of the sensor's origin above the ground\n"
                  "# a number from 0.1 to 10; default 1.73\n"
                  "height_m = 2.0\n") != std::string::npos);
}

TEST_CASE("the documentation has a row for every setting", "[config][dump]") {
  Config config;
  const std::string markdown = describe_markdown();
  for (const Setting& setting : config::settings_of(config).list) {
    CAPTURE(setting.key);
    CHECK(markdown.find("\n| `" + std::string(setting.leaf()) + "` | ") != std::string::npos);
  }
  CHECK(
      markdown.find(
          "| `height_m` | of the sensor's origin above the ground | a number from 0.1 to 10 | `1.73` |\n") !=
      std::string::npos);
}

TEST_CASE("every setting of PaGO has a plain key of its own, a meaning and a default that it accepts",
          "[config][dump]") {
  Config config;
  const Settings settings = config::settings_of(config);
  std::set<std::string> seen;
  for (const Setting& setting : settings.list) {
    CAPTURE(setting.key);
    CHECK(seen.insert(setting.key).second);
    CHECK(setting.key.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_.") == std::string::npos);
    CHECK_FALSE(setting.meaning.empty());
    CHECK(setting.meaning.find('\n') == std::string::npos);
    CHECK(assign(setting, value_of(setting)));
  }
}

}  // namespace
}  // namespace pago
