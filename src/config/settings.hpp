// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "pago/config/describe.hpp"

/// A configuration struct seen as a plain list of settings, so that reading, writing and documenting it need
/// no templates. The list points into the struct that it was made from.
namespace pago::config {

/// An enum's value, by the index of its word.
struct WordSlot {
  std::vector<std::string_view> words;
  std::function<std::size_t()> get;
  std::function<void(std::size_t)> set;
};

using Slot = std::variant<bool*, int*, double*, std::string*, std::span<double>, WordSlot>;

struct Setting {
  std::string key;  ///< from the top: "ground.patchwork.min_range_m"
  std::string meaning;
  Slot slot;
  Within bounds;        ///< of numbers
  std::size_t section;  ///< index in Settings::sections

  /// The key inside its section.
  std::string_view leaf() const { return std::string_view(key).substr(key.rfind('.') + 1); }
};

struct Section {
  std::string key;  ///< empty for the top
  std::string meaning;
};

struct Settings {
  std::vector<Section> sections{{"", ""}};
  std::vector<Setting> list;

  const Setting* find(std::string_view key) const;
  bool has_section(std::string_view key) const;
  /// The setting or section whose key is most like this one; empty where none is.
  std::string nearest(std::string_view key) const;
};

/// A value as written in a file or on the command line, before it is known what it should be.
struct TableValue {};
struct OtherValue {
  std::string_view kind;  ///< "a date or time"
};
using Value =
    std::variant<bool, std::int64_t, double, std::string, std::vector<double>, TableValue, OtherValue>;

/// Whether the value is of the setting's type and within its bounds; then it is stored.
bool assign(const Setting& setting, const Value& value);
Value value_of(const Setting& setting);

/// As in TOML, on one line; words for what is no setting's value.
std::string to_text(const Value& value);

/// What the setting may be: "a number from 0 to 10".
std::string expectation(const Setting& setting);

/// The visitor of describe() that makes the list.
class Collector {
 public:
  explicit Collector(Settings& out) : out_(out) {}

  void operator()(std::string_view key, bool& value, std::string_view meaning) {
    add(key, &value, {}, meaning);
  }
  void operator()(std::string_view key, std::string& value, std::string_view meaning) {
    add(key, &value, {}, meaning);
  }
  void operator()(std::string_view key, int& value, Within bounds, std::string_view meaning) {
    add(key, &value, bounds, meaning);
  }
  void operator()(std::string_view key, double& value, Within bounds, std::string_view meaning) {
    add(key, &value, bounds, meaning);
  }
  template <std::size_t N>
  void operator()(std::string_view key,
                  std::array<double, N>& values,
                  Within bounds,
                  std::string_view meaning) {
    add(key, std::span<double>(values), bounds, meaning);
  }
  template <typename Enum, std::size_t N>
  void operator()(std::string_view key,
                  Enum& value,
                  const Choices<Enum, N>& choices,
                  std::string_view meaning) {
    add(key, word_slot(value, choices.words), {}, meaning);
  }
  template <typename Struct>
  void section(std::string_view key, Struct& part, std::string_view meaning) {
    const std::size_t outer = section_;
    const std::string name = full_key(key);
    section_ = out_.sections.size();
    out_.sections.push_back({name, std::string(meaning)});
    describe(*this, part);
    section_ = outer;
  }

 private:
  template <typename Enum, std::size_t N>
  static WordSlot word_slot(Enum& value, const std::array<std::pair<std::string_view, Enum>, N>& words) {
    WordSlot slot;
    for (const auto& [word, meant] : words) slot.words.push_back(word);
    slot.get = [&value, words] {
      std::size_t i = 0;
      while (i < N && words[i].second != value) ++i;
      return i;
    };
    slot.set = [&value, words](std::size_t i) { value = words[i].second; };
    return slot;
  }
  std::string full_key(std::string_view key) const;
  void add(std::string_view key, Slot slot, Within bounds, std::string_view meaning);

  Settings& out_;
  std::size_t section_ = 0;
};

template <typename Struct>
Settings settings_of(Struct& config) {
  Settings settings;
  Collector collector(settings);
  describe(collector, config);
  return settings;
}

}  // namespace pago::config
