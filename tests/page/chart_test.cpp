// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/page/chart.hpp"

#include <cmath>
#include <cstdio>

#include "page/markup.hpp"
#include "support/catch.hpp"

namespace {

using namespace pago::page;
using Catch::Matchers::Contains;
using namespace pago::test;

struct Place {
  double x = 0.0, y = 0.0;
};

/// Where the corners of the n-th line are drawn.
std::vector<Place> line(const std::string& html, std::size_t n = 0) {
  std::size_t at = html.find("<polyline");
  for (; n > 0; --n) at = html.find("<polyline", at + 1);
  at = html.find("points=\"", at) + 8;
  std::vector<Place> places;
  Place place;
  for (int read = 0; std::sscanf(html.c_str() + at, "%lf,%lf %n", &place.x, &place.y, &read) == 2;
       at += static_cast<std::size_t>(read))
    places.push_back(place);
  return places;
}

Chart chart_of(std::vector<double> x, std::vector<double> y) {
  return {.title = "Height",
          .x = {.label = "distance, m"},
          .y = {.label = "z, m"},
          .series = {{.name = "run", .x = std::move(x), .y = std::move(y)}}};
}

TEST_CASE("values are drawn where the axes say", "[page][chart]") {
  const std::string html = figure(chart_of({0, 50, 100}, {0, 10, 5}));
  CHECK(misplaced_tag(html) == "");
  const auto places = line(html);
  REQUIRE(places.size() == 3);
  CHECK(places[1].x - places[0].x == Approx(places[2].x - places[1].x).margin(0.11));
  CHECK(places[0].y - places[2].y == Approx(0.5 * (places[0].y - places[1].y)).margin(0.11));
  CHECK(places[1].y < places[2].y);  // up is up
  CHECK_THAT(html, Contains(">distance, m</text>") && Contains(">z, m</text>") && Contains(">100</text>"));
  CHECK_THAT(html, Contains("</i>run</li>"));
  // What the script turns places back into values by.
  char text[100];
  std::snprintf(text, sizeof text, "data-x=\"0 100 %.1f %.1f 0\"", places[0].x, places[2].x);
  CHECK_THAT(html, Contains(text));
}

TEST_CASE("a gap interrupts the line, and a point alone is a dot", "[page][chart]") {
  const double gap = std::nan("");
  const std::string html = figure(chart_of({0, 1, 2, 3, 4, 5}, {1, 2, gap, 3, gap, 4}));
  CHECK(times(html, "<polyline") == 1);
  CHECK(times(html, "<circle") == 2);
  CHECK_THAT(html, !Contains("nan"));
}

TEST_CASE("a logarithmic axis leaves out what has no logarithm", "[page][chart]") {
  Chart chart = chart_of({0, 1, 2, 3, 4}, {1, 10, 100, 0, -1});
  chart.y.is_log = true;
  const auto places = line(figure(chart));
  REQUIRE(places.size() == 3);
  CHECK(places[0].y - places[1].y == Approx(places[1].y - places[2].y).margin(0.11));
}

TEST_CASE("a map has one scale", "[page][chart]") {
  Chart chart = chart_of({0, 300, 300, 0}, {0, 0, 40, 40});
  chart.is_map = true;
  const std::string html = figure(chart);
  const auto places = line(html);
  REQUIRE(places.size() == 4);
  CHECK((places[1].x - places[0].x) / 300.0 == Approx((places[1].y - places[2].y) / 40.0).epsilon(0.01));
  for (const Place& place : places) {
    CHECK(place.x >= 56.0);
    CHECK(place.x <= 468.0);
    CHECK(place.y >= 10.0);
  }
}

TEST_CASE("levels are in sight whatever the data, with names that keep apart", "[page][chart]") {
  Chart chart = chart_of({0, 1}, {2, 3});
  chart.levels = {{6.0, "right"}, {6.5, "limit"}};
  const std::string html = figure(chart);
  CHECK(misplaced_tag(html) == "");
  CHECK(times(html, "class=\"level\"") == 2);
  CHECK_THAT(html,
             Contains("<text class=\"tick end\" x=\"464.0\"") && Contains("<text class=\"tick\" x=\"60.0\""));
  CHECK(line(html)[1].y > 60.0);  // the data fill the lower half only
}

TEST_CASE("a long drive is drawn by what can be seen of it", "[page][chart]") {
  std::vector<double> x, y;
  for (int i = 0; i <= 100'000; ++i) x.push_back(i), y.push_back(std::sin(1e-4 * i));
  const std::string html = figure(chart_of(x, y));
  CHECK(line(html).size() < 2000);
  CHECK(line(html).back().x == Approx(468.0).margin(0.11));
}

TEST_CASE("nothing to draw is an empty chart, not an error", "[page][chart]") {
  CHECK(misplaced_tag(figure(chart_of({}, {}))) == "");
  CHECK_THAT(figure(chart_of({2}, {3})), Contains("<circle") && !Contains("nan") && !Contains("inf"));
  CHECK(misplaced_tag(figure(BarChart{.title = "", .label = "", .categories = {}, .series = {}})) == "");
}

TEST_CASE("bars stand on zero, each with its value", "[page][chart]") {
  const std::string html = figure(BarChart{.title = "Axes",
                                           .label = "%",
                                           .categories = {"x", "y"},
                                           .series = {{"a", {2.0, -1.0}, 0}, {"b", {std::nan(""), 1.0}, 1}}});
  CHECK(misplaced_tag(html) == "");
  CHECK(times(html, "<rect") == 3);
  CHECK_THAT(html, Contains("<title>a, y: -1.000</title>") && !Contains("height=\"-"));
}

TEST_CASE("a histogram counts every value once", "[page][chart]") {
  const Series bars = histogram({0.0, 0.1, 0.5, 0.9, 1.0, std::nan("")}, 2);
  CHECK(bars.x == std::vector<double>{0.0, 0.5, 1.0});
  CHECK(bars.y == std::vector<double>{2.0, 3.0});
  const Series log_bars = histogram({1.0, 3.0, 30.0, 100.0, 0.0, -1.0}, 2, true);
  CHECK(log_bars.x[1] == Approx(10.0));
  CHECK(log_bars.y == std::vector<double>{2.0, 2.0});
  CHECK(histogram({-5.0, 0.5, 7.0}, std::vector<double>{0.0, 0.5, 1.0}).y == std::vector<double>{1.0, 2.0});
  CHECK(histogram({3.0, 3.0}, 4).y.size() == 4);
}

}  // namespace
