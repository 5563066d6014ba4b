// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "pago/core/error.hpp"
#include "pago/ground/segmenter.hpp"
#include "support/catch.hpp"

using namespace pago;

TEST_CASE("methods have different names and a line of help each", "[ground][methods]") {
  std::vector<std::string_view> names;
  for (const ground::Method& method : ground::methods()) {
    CHECK_FALSE(method.name.empty());
    CHECK_FALSE(method.summary.empty());
    names.push_back(method.name);
  }
  std::sort(names.begin(), names.end());
  CHECK(std::adjacent_find(names.begin(), names.end()) == names.end());
}

TEST_CASE("an unknown method is refused with the known ones named", "[ground][methods]") {
  GroundConfig config;
  config.method = "patchwrok";
  try {
    ground::make_segmenter(config, Mount{}, 10);
    FAIL("must throw");
  } catch (const Error& error) {
    CHECK(error.where() == "ground.method");
    CHECK(error.problem().find("patchwrok") != std::string::npos);
    CHECK(error.hint().find("patchwork") != std::string::npos);
    CHECK(error.hint().find("lego") != std::string::npos);
  }
}
