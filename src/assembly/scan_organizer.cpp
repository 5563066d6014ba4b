// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/scan_organizer.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "columns.hpp"
#include "pago/hdl64/packet.hpp"
#include "rings.hpp"

namespace pago {
namespace {

/// Coordinates that arithmetic cannot spoil; no LiDAR sees 1,000 km.
bool is_usable(float x_m, float y_m, float z_m) noexcept {
  constexpr float kAbsurdM = 1e6F;
  return std::abs(x_m) < kAbsurdM && std::abs(y_m) < kAbsurdM && std::abs(z_m) < kAbsurdM;
}

/// How far the head has turned when it looks at the point: clockwise from the rear, [0, 1] revolutions.
float turn_of(float x_m, float y_m) noexcept {
  if (x_m == 0.0F && y_m == 0.0F) return kNoTurn;
  constexpr float kRevPerRad = 0.5F * std::numbers::inv_pi_v<float>;
  return std::clamp(0.5F - std::atan2(y_m, x_m) * kRevPerRad, 0.0F, 1.0F);
}

}  // namespace

int scan_columns(std::int64_t rotation_ns) noexcept {
  constexpr std::int64_t kShortest_ns = 40'000'000, kLongest_ns = 250'000'000;
  constexpr double kStep = 1.1;
  if (rotation_ns < kShortest_ns || rotation_ns > kLongest_ns) return kScanColumns;
  const auto firings = static_cast<double>(rotation_ns / hdl64::kFiringPeriod_ns);
  double columns = kScanColumns;
  while (columns < firings) columns *= kStep;
  while (columns / kStep >= firings) columns /= kStep;
  return std::min(static_cast<int>(columns), kMaxColumns);
}

struct ScanOrganizer::State {
  State(std::size_t max_points, const SelfFilter& own_body)
      : self(own_body), turn_rev(max_points), columns(max_points, kMaxColumns) {}

  SelfFilter self;
  AlignedArray<float> turn_rev;
  std::size_t size = 0;  // of the last sweep
  RingFinder rings;
  ColumnPlacer columns;
  std::uint64_t guessed_rings = 0, homeless_returns = 0, self_hits = 0;

  /// Makes the points fit to be computed with.
  std::span<const float> take(Sweep& sweep) noexcept {
    assert(sweep.size <= turn_rev.size());
    size = sweep.size;
    for (std::size_t i = 0; i < size; ++i) {
      const bool is_own = self.has_box() && self.is_own(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]) &&
                          turn_of(sweep.x_m[i], sweep.y_m[i]) != kNoTurn;
      self_hits += is_own ? 1U : 0U;
      if (is_own || !is_usable(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]))
        sweep.x_m[i] = sweep.y_m[i] = sweep.z_m[i] = 0.0F;
      turn_rev[i] = turn_of(sweep.x_m[i], sweep.y_m[i]);
    }
    return turn_rev.first(size);
  }
};

ScanOrganizer::ScanOrganizer(std::size_t max_points, const SelfFilter& self)
    : state_(std::make_unique<State>(max_points, self)) {}
ScanOrganizer::~ScanOrganizer() = default;

RingSource ScanOrganizer::organize(Sweep& sweep) noexcept {
  const std::span<const float> turn = state_->take(sweep);
  const RingSource source = state_->rings.assign(sweep, turn);
  state_->guessed_rings += source == RingSource::kWraps ? 0U : 1U;
  state_->homeless_returns += state_->columns.place(sweep, turn);
  return source;
}

void ScanOrganizer::place_columns(Sweep& sweep) noexcept {
  state_->homeless_returns += state_->columns.place(sweep, state_->take(sweep));
}

std::span<const float> ScanOrganizer::turn_rev() const noexcept {
  return state_->turn_rev.first(state_->size);
}
std::uint64_t ScanOrganizer::scans_with_guessed_rings() const noexcept {
  return state_->guessed_rings;
}
std::uint64_t ScanOrganizer::self_hits() const noexcept {
  return state_->self_hits;
}
std::uint64_t ScanOrganizer::returns_without_cell() const noexcept {
  return state_->homeless_returns;
}

}  // namespace pago
