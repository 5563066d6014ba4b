// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>

#include "settings.hpp"

namespace pago::config {
namespace {

template <typename... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// The fewest digits that give the same double back. 3.0 gives "3".
std::string shortest(double value) {
  const double size = std::abs(value);
  const bool is_handy = size == 0.0 || (size >= 1e-5 && size < 1e15);
  const auto format = is_handy ? std::chars_format::fixed : std::chars_format::scientific;
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value, format).ptr;
  return {digits.data(), end};
}

std::string toml_number(double value) {
  const std::string text = shortest(value);
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') {
      out += {'\\', letter};
    } else if (static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f) {
      std::array<char, 8> escape{};
      std::snprintf(escape.data(), escape.size(), "\\u%04X", static_cast<unsigned>(letter));
      out += escape.data();
    } else {
      out += letter;
    }
  }
  return out + '"';
}

std::optional<double> number_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* number = std::get_if<double>(&value)) return *number;
  return std::nullopt;
}

bool fits(double number, Within bounds) {
  return std::isfinite(number) && number >= bounds.min && number <= bounds.max;
}

template <typename T>
bool assign_same(T* target, const Value& value) {
  const T* same = std::get_if<T>(&value);
  if (same != nullptr) *target = *same;
  return same != nullptr;
}

bool assign_whole(int* target, const Value& value, Within bounds) {
  const auto* whole = std::get_if<std::int64_t>(&value);
  if (whole == nullptr || !fits(static_cast<double>(*whole), bounds) || !std::in_range<int>(*whole))
    return false;
  *target = static_cast<int>(*whole);
  return true;
}

bool assign_number(double* target, const Value& value, Within bounds) {
  const auto number = number_in(value);
  if (!number || !fits(*number, bounds)) return false;
  *target = *number;
  return true;
}

bool assign_numbers(std::span<double> target, const Value& value, Within bounds) {
  const auto* numbers = std::get_if<std::vector<double>>(&value);
  if (numbers == nullptr || numbers->size() != target.size()) return false;
  if (!std::ranges::all_of(*numbers, [&](double number) { return fits(number, bounds); })) return false;
  std::ranges::copy(*numbers, target.begin());
  return true;
}

bool assign_word(const WordSlot& slot, const Value& value) {
  const auto* word = std::get_if<std::string>(&value);
  if (word == nullptr) return false;
  const auto found = std::ranges::find(slot.words, *word);
  if (found == slot.words.end()) return false;
  slot.set(static_cast<std::size_t>(found - slot.words.begin()));
  return true;
}

std::string range_text(Within bounds) {
  const bool has_min = std::isfinite(bounds.min), has_max = std::isfinite(bounds.max);
  if (has_min && has_max) return " from " + shortest(bounds.min) + " to " + shortest(bounds.max);
  if (has_min) return " of at least " + shortest(bounds.min);
  return has_max ? " of at most " + shortest(bounds.max) : "";
}

std::string words_text(const std::vector<std::string_view>& words) {
  std::string out;
  for (const auto word : words) out += (out.empty() ? "" : ", ") + in_quotes(word);
  return out;
}

}  // namespace

bool assign(const Setting& setting, const Value& value) {
  return std::visit(
      Overloaded{
          [&](bool* flag) { return assign_same(flag, value); },
          [&](std::string* text) { return assign_same(text, value); },
          [&](int* whole) { return assign_whole(whole, value, setting.bounds); },
          [&](double* number) { return assign_number(number, value, setting.bounds); },
          [&](std::span<double> numbers) { return assign_numbers(numbers, value, setting.bounds); },
          [&](const WordSlot& word) { return assign_word(word, value); },
      },
      setting.slot);
}

Value value_of(const Setting& setting) {
  return std::visit(Overloaded{
                        [](const auto* value) { return Value(*value); },
                        [](const int* whole) { return Value(std::int64_t{*whole}); },
                        [](std::span<double> numbers) {
                          return Value(std::vector<double>(numbers.begin(), numbers.end()));
                        },
                        [](const WordSlot& word) {
                          const std::size_t i = word.get();
                          return i < word.words.size() ? Value(std::string(word.words[i]))
                                                       : Value(OtherValue{"none of its words"});
                        },
                    },
                    setting.slot);
}

std::string to_text(const Value& value) {
  return std::visit(Overloaded{
                        [](bool flag) { return std::string(flag ? "true" : "false"); },
                        [](std::int64_t whole) { return std::to_string(whole); },
                        [](double number) { return toml_number(number); },
                        [](const std::string& text) { return in_quotes(text); },
                        [](const std::vector<double>& numbers) {
                          std::string out;
                          for (const double number : numbers)
                            out += (out.empty() ? "" : ", ") + toml_number(number);
                          return "[" + out + "]";
                        },
                        [](TableValue) { return std::string("a table"); },
                        [](OtherValue other) { return std::string(other.kind); },
                    },
                    value);
}

std::string expectation(const Setting& setting) {
  const std::string range = range_text(setting.bounds);
  return std::visit(Overloaded{
                        [](const bool*) -> std::string { return "true or false"; },
                        [](const std::string*) -> std::string { return "text"; },
                        [&](const int*) { return "a whole number" + range; },
                        [&](const double*) { return "a number" + range; },
                        [&](std::span<double> numbers) {
                          return "an array of " + std::to_string(numbers.size()) + " numbers" + range;
                        },
                        [](const WordSlot& word) { return "one of " + words_text(word.words); },
                    },
                    setting.slot);
}

}  // namespace pago::config
