// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "line_lookup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pago::ground {
namespace {

constexpr float kOutOfReach = std::numeric_limits<float>::infinity();

/// Up to how many segments away the angle stays below the bound; at most half-way round.
int search_reach(const LinefitConfig& c) {
  const double segments = c.line_search_angle_rad * c.segments / (2.0 * std::numbers::pi);
  return std::clamp(static_cast<int>(std::ceil(segments)) - 1, 0, c.segments / 2);
}

}  // namespace

LineLookup::LineLookup(const LinefitConfig& config)
    : bins_(config.bins),
      segments_(config.segments),
      search_(search_reach(config)),
      limit_m_(static_cast<float>(config.max_distance_to_line_m)),
      min_range_m_(config.min_range_m),
      bin_m_((config.max_range_m - config.min_range_m) / config.bins),
      room_(max_lines(static_cast<std::size_t>(config.bins))),
      lines_(1 + room_ * static_cast<std::size_t>(config.segments)),
      num_lines_(static_cast<std::size_t>(config.segments)),
      own_(static_cast<std::size_t>(config.bins) * static_cast<std::size_t>(config.segments)),
      answers_(own_.size() + 1) {
  lines_[kNone].base_m = kOutOfReach;
}

std::span<GroundLine> LineLookup::room(int segment) noexcept {
  return {&lines_[1 + room_ * static_cast<std::size_t>(segment)], room_};
}

int LineLookup::wrapped(int segment) const noexcept {
  if (segment < 0) return segment + segments_;
  return segment < segments_ ? segment : segment - segments_;
}

/// Of lines that overlap, the last one counts: bins that it holds in full are its own, for those at its ends
/// it depends.
void LineLookup::cover(int segment) noexcept {
  const auto s = static_cast<std::size_t>(segment), stride = static_cast<std::size_t>(segments_);
  for (int bin = 0; bin < bins_; ++bin) own_[static_cast<std::size_t>(bin) * stride + s] = {};
  // Whether a return at a bin's very border is in it is a matter of rounding.
  constexpr double kRounding_m = 1e-3;
  const double slack = kRounding_m / bin_m_;
  for (std::size_t k = 0; k < num_lines_[s]; ++k) {
    const auto number = static_cast<std::uint32_t>(1 + room_ * s + k);
    const GroundLine& held = line(number);
    const double from = (static_cast<double>(held.from_m) - min_range_m_) / bin_m_;
    const double until = (static_cast<double>(held.until_m) - min_range_m_) / bin_m_;
    const int first = std::max(0, static_cast<int>(std::floor(from - slack)));
    const int last = std::min(bins_ - 1, static_cast<int>(std::floor(until + slack)));
    for (int bin = first; bin <= last; ++bin) {
      const bool is_full = from < bin - slack && bin + 1 + slack < until;
      const auto near_m = static_cast<float>(min_range_m_ + (bin - slack) * bin_m_);
      const auto far_m = static_cast<float>(min_range_m_ + (bin + 1 + slack) * bin_m_);
      Cover& cover = own_[static_cast<std::size_t>(bin) * stride + s];
      cover.line = is_full ? number : kDepends;
      cover.top_m = std::max({cover.top_m, held.height_at(near_m), held.height_at(far_m)});
    }
  }
}

LineLookup::Answer LineLookup::answer(std::size_t cell) const noexcept {
  const std::size_t stride = static_cast<std::size_t>(segments_);
  const Cover* const bin = &own_[cell / stride * stride];
  const int segment = static_cast<int>(cell % stride);
  const Cover& own = bin[segment];
  // More than what rounding moves a line by.
  const float above = limit_m_ + 1e-3F;
  if (own.line != kNone && own.line != kDepends) return {own.line, own.line, own.top_m + above};

  Answer answer{own.line, kNone, own.top_m};
  for (int k = 1; k <= search_; ++k) {
    const Cover &left = bin[wrapped(segment + k)], &right = bin[wrapped(segment - k)];
    answer.top_m = std::max({answer.top_m, left.top_m, right.top_m});
    if (answer.nearest != kNone) continue;
    const bool depends = left.line == kDepends || right.line == kDepends;
    answer.nearest = depends ? kDepends : left.line;
    answer.other = right.line;
    if (left.line == kNone && !depends) std::swap(answer.nearest, answer.other);
    if (answer.nearest != kNone && answer.nearest != kDepends) break;
  }
  answer.top_m += above;
  return answer;
}

float LineLookup::distance_in(int segment, const RangeHeight& p) const noexcept {
  const auto s = static_cast<std::size_t>(segment);
  for (std::size_t k = num_lines_[s]; k-- > 0;) {
    const GroundLine& candidate = lines_[1 + room_ * s + k];
    if (candidate.holds(p.range_m)) return std::fabs(candidate.above(p));
  }
  return kOutOfReach;
}

float LineLookup::search(std::size_t cell, const RangeHeight& p) const noexcept {
  const int segment = static_cast<int>(cell % static_cast<std::size_t>(segments_));
  float off = distance_in(segment, p);
  for (int k = 1; off == kOutOfReach && k <= search_; ++k)
    off = std::fmin(distance_in(wrapped(segment + k), p), distance_in(wrapped(segment - k), p));
  return off;
}

}  // namespace pago::ground
