// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "svg.hpp"

#include "pago/core/text.hpp"
#include "pago/page/html.hpp"

namespace pago::page {
namespace {

constexpr std::size_t kColours = 8;

std::string line(double x1, double y1, double x2, double y2, const char* css_class) {
  return format(R"(<line class="%s" x1="%.1f" y1="%.1f" x2="%.1f" y2="%.1f"/>)", css_class, x1, y1, x2, y2);
}

}  // namespace

std::string colour_class(Colour colour) {
  return colour == kNeutral ? "cn" : format("c%zu", colour % kColours);
}

std::string text_at(double x, double y, std::string_view css_class, std::string_view text) {
  return format(R"(<text class="%s" x="%.1f" y="%.1f">)", std::string(css_class).c_str(), x, y) +
         escape(text) + "</text>";
}

std::string rectangle(const Box& box, std::string_view css_class, std::string_view tooltip) {
  return format(R"(<rect class="%s" x="%.1f" y="%.1f" width="%.1f" height="%.1f">)",
                std::string(css_class).c_str(), box.left, box.top, box.right - box.left,
                box.bottom - box.top) +
         "<title>" + escape(tooltip) + "</title></rect>";
}

std::string x_axis(const Scale& scale, const Box& box, const std::string& label) {
  std::string svg;
  for (const Tick& tick : ticks_of(scale, 6)) {
    const double x = scale(tick.value);
    svg += line(x, box.top, x, box.bottom, "rule") + text_at(x, box.bottom + 16, "tick mid", tick.text);
  }
  return svg + line(box.left, box.bottom, box.right, box.bottom, "axis") +
         text_at(0.5 * (box.left + box.right), box.bottom + 34, "label mid", label);
}

std::string y_axis(const Scale& scale, const Box& box, const std::string& label) {
  std::string svg;
  for (const Tick& tick : ticks_of(scale, 5)) {
    const double y = scale(tick.value);
    svg += line(box.left, y, box.right, y, "rule") + text_at(box.left - 6, y + 4, "tick end", tick.text);
  }
  return svg +
         format(R"svg(<text class="label mid" transform="translate(13 %.1f) rotate(-90)">)svg",
                0.5 * (box.top + box.bottom)) +
         escape(label) + "</text>";
}

std::string figure_around(const std::string& title,
                          const std::string& caption,
                          const Legend& legend,
                          double height_px,
                          const std::string& attributes,
                          const std::string& svg) {
  std::string html = "<figure><h3>" + escape(title) + "</h3>";
  if (!legend.empty()) {
    html += "<ul class=\"legend\">";
    for (const auto& [name, colour] : legend)
      html += "<li data-series=\"" + colour_class(colour) + "\"><i class=\"" + colour_class(colour) +
              "\"></i>" + escape(name) + "</li>";
    html += "</ul>";
  }
  html += format(R"(<svg viewBox="0 0 %.0f %.0f" role="img" aria-label=")", kWidth_px, height_px) +
          escape(title) + "\"" + attributes + ">" + svg + "</svg>";
  if (!caption.empty()) html += "<figcaption>" + escape(caption) + "</figcaption>";
  return html + "</figure>\n";
}

}  // namespace pago::page
