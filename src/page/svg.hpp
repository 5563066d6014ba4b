// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "axes.hpp"
#include "pago/page/chart.hpp"

/// Pieces that the figures share. Pictures are 480 wide, so that letters of size 13 stay readable when the
/// picture shrinks to a phone's width.
namespace pago::page {

inline constexpr double kWidth_px = 480.0;

/// The rectangle that data are drawn in.
struct Box {
  double left = 56.0, top = 10.0, right = kWidth_px - 12.0, bottom = 0.0;
};

/// "c3"; "cn" for the neutral colour.
std::string colour_class(Colour colour);

std::string x_axis(const Scale& scale, const Box& box, const std::string& label);
std::string y_axis(const Scale& scale, const Box& box, const std::string& label);
std::string text_at(double x, double y, std::string_view css_class, std::string_view text);
std::string rectangle(const Box& box, std::string_view css_class, std::string_view tooltip);

/// One entry: name and colour.
using Legend = std::vector<std::pair<std::string, Colour>>;
/// Heading, legend, picture and caption. `attributes` go into the svg element.
std::string figure_around(const std::string& title,
                          const std::string& caption,
                          const Legend& legend,
                          double height_px,
                          const std::string& attributes,
                          const std::string& svg);

}  // namespace pago::page
