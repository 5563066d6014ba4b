// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "src/config/settings.hpp"

#include <cmath>
#include <limits>

#include "support/catch.hpp"

namespace pago::test {
namespace {

enum class Mode { kFast, kExact };

struct Inner {
  int count = 4;
  std::array<double, 3> weights{1.0, 2.0, 3.0};
};
template <typename Visitor>
void describe(Visitor& v, Inner& c) {
  v("count", c.count, within(1, 10), "how many");
  v("weights", c.weights, within(0.0, 5.0), "how much each");
}

struct Outer {
  bool enabled = false;
  Mode mode = Mode::kFast;
  Inner inner;
  double gain = 0.5;
  double floor = 0.0;
};
template <typename Visitor>
void describe(Visitor& v, Outer& c) {
  v("enabled", c.enabled, "whether");
  v("mode", c.mode, choices(std::pair{"fast", Mode::kFast}, std::pair{"exact", Mode::kExact}), "which");
  v.section("inner", c.inner, "the inside");
  v("gain", c.gain, within(0.0, 1.0), "strength");
  v("floor", c.floor, within(-1.0, std::numeric_limits<double>::infinity()), "lower end");
}

using config::Value;

struct Fixture {
  Outer outer;
  config::Settings settings = config::settings_of(outer);
  bool assign(std::string_view key, const Value& value) { return config::assign(*settings.find(key), value); }
};

TEST_CASE("a struct is listed with full keys, and each setting knows its section", "[config][settings]") {
  Fixture f;
  std::vector<std::string> keys;
  for (const auto& setting : f.settings.list) keys.push_back(setting.key);
  CHECK(keys == std::vector<std::string>{"enabled", "mode", "inner.count", "inner.weights", "gain", "floor"});
  CHECK(f.settings.sections.size() == 2);
  CHECK(f.settings.find("inner.count")->section == 1);
  CHECK(f.settings.find("gain")->section == 0);
  CHECK(f.settings.find("inner.count")->leaf() == "count");
  CHECK(f.settings.find("count") == nullptr);
}

TEST_CASE("each type takes its own values", "[config][settings]") {
  Fixture f;
  CHECK(f.assign("enabled", true));
  CHECK(f.assign("mode", std::string("exact")));
  CHECK(f.assign("inner.count", std::int64_t{7}));
  CHECK(f.assign("inner.weights", std::vector<double>{0.0, 4.5, 5.0}));
  CHECK(f.assign("gain", 0.25));
  CHECK(f.outer.enabled);
  CHECK(f.outer.mode == Mode::kExact);
  CHECK(f.outer.inner.count == 7);
  CHECK(f.outer.inner.weights == std::array{0.0, 4.5, 5.0});
  CHECK(f.outer.gain == 0.25);
}

TEST_CASE("a whole number will do for a number, but not the reverse", "[config][settings]") {
  Fixture f;
  CHECK(f.assign("gain", std::int64_t{1}));
  CHECK(f.outer.gain == 1.0);
  CHECK_FALSE(f.assign("inner.count", 2.0));
  CHECK(f.outer.inner.count == 4);
}

TEST_CASE("what does not fit changes nothing", "[config][settings]") {
  Fixture f;
  CHECK_FALSE(f.assign("enabled", std::int64_t{1}));
  CHECK_FALSE(f.assign("enabled", std::string("true")));
  CHECK_FALSE(f.assign("mode", std::string("Fast")));
  CHECK_FALSE(f.assign("mode", std::int64_t{0}));
  CHECK_FALSE(f.assign("inner.count", std::int64_t{11}));
  CHECK_FALSE(f.assign("inner.count", std::int64_t{0}));
  CHECK_FALSE(f.assign("inner.count", std::int64_t{4'294'967'300}));
  CHECK_FALSE(f.assign("inner.weights", std::vector<double>{1.0, 2.0}));
  CHECK_FALSE(f.assign("inner.weights", std::vector<double>{1.0, 2.0, 3.0, 4.0}));
  CHECK_FALSE(f.assign("inner.weights", std::vector<double>{1.0, 2.0, 5.1}));
  CHECK_FALSE(f.assign("inner.weights", std::vector<double>{1.0, 2.0, std::nan("")}));
  CHECK_FALSE(f.assign("gain", std::nan("")));
  CHECK_FALSE(f.assign("floor", std::numeric_limits<double>::infinity()));
  CHECK_FALSE(f.assign("gain", config::TableValue{}));
  CHECK(f.outer.inner.weights == std::array{1.0, 2.0, 3.0});
  CHECK(f.outer.gain == 0.5);
  CHECK(f.outer.floor == 0.0);
}

TEST_CASE("what a setting may be is said in words", "[config][settings]") {
  Fixture f;
  const auto expected = [&](std::string_view key) { return expectation(*f.settings.find(key)); };
  CHECK(expected("enabled") == "true or false");
  CHECK(expected("mode") == "one of \"fast\", \"exact\"");
  CHECK(expected("inner.count") == "a whole number from 1 to 10");
  CHECK(expected("inner.weights") == "an array of 3 numbers from 0 to 5");
  CHECK(expected("gain") == "a number from 0 to 1");
  CHECK(expected("floor") == "a number of at least -1");
}

TEST_CASE("numbers are written with the digits that give them back", "[config][settings]") {
  CHECK(config::to_text(0.1) == "0.1");
  CHECK(config::to_text(3.0) == "3.0");
  CHECK(config::to_text(1e6) == "1000000.0");
  CHECK(config::to_text(1e22) == "1e+22");
  CHECK(config::to_text(-0.0) == "-0.0");
  CHECK(config::to_text(1.0 / 3.0) == "0.3333333333333333");
  CHECK(config::to_text(std::string("a\"b\\c\nd")) == "\"a\\\"b\\\\c\\u000Ad\"");
}

TEST_CASE("the nearest key is found by spelling, also in another section", "[config][settings]") {
  Fixture f;
  CHECK(f.settings.nearest("inner.cuont") == "inner.count");
  CHECK(f.settings.nearest("weights") == "inner.weights");
  CHECK(f.settings.nearest("innr") == "inner");
  CHECK(f.settings.nearest("outer.gain") == "gain");
  CHECK(f.settings.nearest("spectroscope") == "");
}

}  // namespace
}  // namespace pago::test
