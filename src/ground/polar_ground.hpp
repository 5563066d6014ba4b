// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "label.hpp"
#include "plane_fit.hpp"
#include "polar_bins.hpp"

namespace pago::ground {

/// What methods share that judge polar bins one by one: a bin is judged when the head has passed it, the rest
/// at the sweep's end, and then each return is ground if it lies in its bin's half-space. [front thread]
/// everything but the constructor; real-time safe.
class PolarGround {
 public:
  /// [set-up] Allocates.
  PolarGround(PolarGrid grid, const Mount& mount, std::uint32_t max_returns);

  const PolarGrid& grid() const noexcept { return bins_.grid(); }

  void begin() noexcept { bins_.begin(); }

  /// Returns lower than `min_z_m` are in no bin. `judge(bin, points)` gives the half-space that is ground.
  template <typename Judge>
  void accept(const SweepPart& part, float min_z_m, const Judge& judge) noexcept {
    if (part.last) return;  // finish() comes next
    const Coordinates returns = locate(*part.sweep, part.returns_until, min_z_m);
    bins_.sort_swept(returns, swept_arc(part, returns));
    judge_fresh_bins(judge);
  }

  template <typename Judge>
  void finish(Sweep& sweep, float min_z_m, const Judge& judge) noexcept {
    const Coordinates returns = locate(sweep, sweep.size, min_z_m);
    bins_.sort_rest(returns);
    judge_fresh_bins(judge);
    label_by_bin(returns, bins_.bin_of(), ground_.data(), sweep);
  }

 private:
  template <typename Judge>
  void judge_fresh_bins(const Judge& judge) noexcept {
    for (int bin = 0; bin < grid().num_bins(); ++bin)
      if (bins_.is_fresh(bin)) ground_[static_cast<std::size_t>(bin)] = judge(bin, bins_.points(bin));
  }
  Coordinates locate(const Sweep& sweep, std::uint32_t until, float min_z_m) noexcept;

  Leveller level_;
  PolarBins bins_;
  AlignedArray<HalfSpace> ground_;  // per bin, and one for the returns outside
};

}  // namespace pago::ground
