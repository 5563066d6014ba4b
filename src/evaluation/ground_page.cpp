// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "ground_summaries.hpp"
#include "pago/core/text.hpp"

namespace pago::evaluation {
namespace {

/// Okabe and Ito's colours, which colour-blind readers can tell apart as well; dashed when they come again.
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"};

constexpr const char* kStyle =
    "body{font:15px/1.5 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse}td,th{padding:.2em .8em;text-align:right;border-bottom:1px solid #ddd}"
    "td:first-child,th:first-child{text-align:left}svg{width:100%;height:auto;font:12px sans-serif}"
    "figure{margin:1em 0}.line{fill:none;stroke-width:1.5}.grid{stroke:#ddd}";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else
      result += c;
  }
  return result;
}

const char* colour_of(std::size_t method) {
  return kColours[method % kColours.size()];
}
const char* dashes_of(std::size_t method) {
  return method < kColours.size() ? "" : " stroke-dasharray='5 3'";
}

std::string table(const GroundComparison& comparison) {
  const std::vector<GroundSummary> all = summaries(comparison);
  std::string text = "<table><tr><th>method<th>precision<th>recall<th>F1<th>F1 of all points together</tr>\n";
  for (std::size_t i = 0; i < all.size(); ++i) {
    const GroundScore &mean = all[i].mean, &deviation = all[i].deviation;
    text += format(
        "<tr><td><svg viewBox='0 0 24 10' style='width:24px'><path class='line' stroke='%s'%s "
        "d='M0 5H24'/></svg> %s",
        colour_of(i), dashes_of(i), escaped(comparison.methods[i].method).c_str());
    for (const auto figure : kReported)
      text += "<td>" + percent(mean.*figure) + " &plusmn; " + percent(deviation.*figure);
    text += "<td>" + percent(all[i].pooled.f1) + "</tr>\n";
  }
  return text + "</table>\n";
}

/// One score over the frames. Heights go from the worst score, rounded down, to 100 %.
class Plot {
 public:
  Plot(const GroundComparison& comparison, double GroundScore::*figure)
      : comparison_(comparison), figure_(figure) {
    for (const GroundComparison::Row& row : comparison.methods)
      for (const GroundCounts& counts : row.counts)  // of NaN and a number, the first stays
        lowest_ = std::min(lowest_, std::floor(10.0 * (ground_score(counts).*figure)) / 10.0);
  }

  std::string svg() const {
    std::string text = format("<svg viewBox='0 0 %g %g'>\n", kWidth, kHeight) + grid();
    for (std::size_t i = 0; i < comparison_.methods.size(); ++i) text += line(i);
    return text + "</svg>";
  }

 private:
  static constexpr double kWidth = 960.0, kHeight = 260.0, kLeft = 45.0, kRight = 15.0, kTop = 10.0,
                          kBottom = 30.0;

  double x(std::uint64_t frame) const {
    const auto first = static_cast<double>(comparison_.frames.front());
    const double length = std::max(1.0, static_cast<double>(comparison_.frames.back()) - first);
    return kLeft + (static_cast<double>(frame) - first) / length * (kWidth - kLeft - kRight);
  }
  double y(double score) const { return kTop + (1.0 - score) / (1.0 - lowest_) * (kHeight - kTop - kBottom); }

  std::string grid() const {
    std::string text;
    const int steps = 5;
    for (int i = 0; i <= steps; ++i) {
      const double score = lowest_ + (1.0 - lowest_) * i / steps;
      text +=
          format("<path class='grid' d='M%g %.1fH%g'/><text x='%g' y='%.1f' text-anchor='end'>%g</text>\n",
                 kLeft, y(score), kWidth - kRight, kLeft - 6.0, y(score) + 4.0, 100.0 * score);
    }
    for (const std::uint64_t frame : {comparison_.frames.front(), comparison_.frames.back()})
      text += format("<text x='%.1f' y='%g' text-anchor='middle'>%llu</text>\n", x(frame), kHeight - 10.0,
                     static_cast<unsigned long long>(frame));
    return text;
  }

  std::string line(std::size_t method) const {
    const GroundComparison::Row& row = comparison_.methods[method];
    std::string path, dots;
    bool is_on = false;
    for (std::size_t i = 0; i < row.counts.size(); ++i) {
      const double score = ground_score(row.counts[i]).*figure_;
      if (std::isnan(score)) {
        is_on = false;  // a gap
        continue;
      }
      const double px = x(comparison_.frames[i]), py = y(score);
      path += format("%c%.1f %.1f", is_on ? 'L' : 'M', px, py);
      is_on = true;
      dots += format("<circle cx='%.1f' cy='%.1f' r='1.5' fill='%s'/>", px, py, colour_of(method));
    }
    return format("<path class='line' stroke='%s'%s d='", colour_of(method), dashes_of(method)) + path +
           "'><title>" + escaped(row.method) + "</title></path>" + dots + "\n";
  }

  const GroundComparison& comparison_;
  double GroundScore::*figure_;
  double lowest_ = 0.9;
};

std::string section(const GroundComparison& comparison) {
  return "<h2>Protocol " + std::string(to_string(comparison.protocol)) + "</h2>\n<p>" +
         std::string(rule_of(comparison.protocol)) + "; " + frames_text(comparison, summaries(comparison)) +
         ". In percent; mean and standard deviation over the frames.</p>\n" + table(comparison) +
         "<figure><figcaption>Precision, %, by frame</figcaption>\n" +
         Plot(comparison, &GroundScore::precision).svg() +
         "</figure>\n<figure><figcaption>Recall, %, by frame</figcaption>\n" +
         Plot(comparison, &GroundScore::recall).svg() + "</figure>\n";
}

}  // namespace

std::string ground_page(const std::string& title, std::span<const GroundComparison> comparisons) {
  std::string text = "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>" + escaped(title) +
                     "</title>\n<style>" + kStyle + "</style></head>\n<body><h1>" + escaped(title) +
                     "</h1>\n<p>The two protocols count vegetation differently: their figures cannot be "
                     "compared with each other.</p>\n";
  for (const GroundComparison& comparison : comparisons) text += section(comparison);
  return text + "</body></html>\n";
}

}  // namespace pago::evaluation
