// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "pago/output/map_sweep.hpp"
#include "publication.hpp"

namespace pago {

/// Lends the points of keyframes to the publisher, who puts them into the saved map; a stage, the last one of
/// the estimate thread. A replay waits for a free cloud; live, a keyframe that finds none, or no room on the
/// way, stays out of the map and is counted. With no clouds at all it does nothing.
class MapFeed {
 public:
  /// [set-up]
  MapFeed(std::uint32_t num_clouds, const RefinedState& refined, Outlet& outlet, bool waits)
      : free_(num_clouds + 1), refined_(refined), outlet_(outlet), waits_(waits) {
    clouds_.reserve(num_clouds);
    for (std::uint32_t i = 0; i < num_clouds; ++i) free_.try_push(&clouds_.emplace_back(kMaxDensePoints));
  }

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept {
    if (clouds_.empty() || !sweep.estimate.is_keyframe) return;
    if (spare_ == nullptr && waits_) spare_ = pop(free_);
    if (spare_ == nullptr && !free_.try_pop(spare_)) {
      ++lost_;
      return;
    }
    output::take(sweep, refined_, *spare_);
    if (outlet_.try_send({.kind = News::Kind::kMapSweep, .pose = {}, .record = {}, .map_sweep = spare_}))
      spare_ = nullptr;
    else
      ++lost_;
  }

  /// [publisher thread]
  void give_back(output::MapSweep* cloud) noexcept { free_.try_push(cloud); }
  /// [after the end]
  std::uint64_t lost() const noexcept { return lost_; }

 private:
  std::vector<output::MapSweep> clouds_;
  platform::Channel<output::MapSweep*> free_;  // publisher to estimate thread
  const RefinedState& refined_;
  Outlet& outlet_;
  bool waits_;
  output::MapSweep* spare_ = nullptr;  // one that could not be sent
  std::uint64_t lost_ = 0;
};

}  // namespace pago
