// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/page/html.hpp"

#include <cmath>

#include "page/markup.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::page;
using Catch::Matchers::Contains;
using namespace pago::test;

TEST_CASE("text stays text, whatever is in it", "[page][html]") {
  CHECK(escape("a<b> & \"c\" 'd'") == "a&lt;b&gt; &amp; &quot;c&quot; &#39;d&#39;");
  CHECK(escape("drift ± 3 °") == "drift ± 3 °");
  CHECK(escape("a\xFF\x62") == "a\xEF\xBF\xBD\x62");        // no UTF-8
  CHECK(escape("\xE2\x82") == "\xEF\xBF\xBD\xEF\xBF\xBD");  // cut off
}

TEST_CASE("a page is one file that fetches nothing, and every tag is closed", "[page][html]") {
  const std::string html =
      document({"<runs>", "lead & more",
                section("Part", "text",
                        tiles({{"drift", "0.5", "%", "of the way"}, {"time", "3", "ms"}}) +
                            notice("Note", "look") + details("more", paragraph("hidden"))),
                "pago evaluate"});
  CHECK(misplaced_tag(html) == "");
  CHECK_FALSE(fetches(html));
  CHECK_THAT(html, Contains("<title>&lt;runs&gt;</title>") && Contains("<h1>&lt;runs&gt;</h1>"));
  CHECK_THAT(html, Contains("<b>0.5<span>%</span></b><small>of the way</small>"));
  CHECK(html == document({"<runs>", "lead & more",
                          section("Part", "text",
                                  tiles({{"drift", "0.5", "%", "of the way"}, {"time", "3", "ms"}}) +
                                      notice("Note", "look") + details("more", paragraph("hidden"))),
                          "pago evaluate"}));
}

TEST_CASE("the check of tags finds what is wrong", "[page][html]") {
  CHECK(misplaced_tag("<p><b>x</p></b>") == "</p>");
  CHECK(misplaced_tag("<p>x") == "p stays open");
  CHECK(misplaced_tag("<script>if(a<b)</script><br/>") == "");
  CHECK(fetches("<img src=\"a.png\"/>"));
}

TEST_CASE("a table marks the best figure and says whether a difference is good", "[page][html]") {
  Cell better{"0.3"};
  better.note = "-0.2";
  better.tone = Tone::kGood;
  better.is_best = true;
  const std::string html = table({{"", "a", "b"}, {{{"t_rel"}, {"0.5"}, better}}});
  CHECK(misplaced_tag(html) == "");
  CHECK_THAT(html, Contains("<td class=\"best\">0.3<small class=\"good\">-0.2</small></td>"));
  CHECK(times(html, "<td>") == 2);
}

TEST_CASE("numbers have four digits that count, and what is none is a dash", "[page][html]") {
  CHECK(number(0.66674) == "0.6667");
  CHECK(number(3.5014) == "3.501");
  CHECK(number(25.347) == "25.35");
  CHECK(number(125.04) == "125.0");
  CHECK(number(4661.3) == "4661");
  CHECK(number(std::nan("")) == "–");
  CHECK(difference(0.25) == "+0.2500");
  CHECK(difference(-25.0) == "-25.00");
}

}  // namespace
