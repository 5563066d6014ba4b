// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "pago/mapping/keyframe_mapping.hpp"
#include "pago/mapping/mapping.hpp"

namespace pago::mapping {

/// The stage that mapping.method names. [set-up] constructor; [estimate thread] the rest: as MappingStage or
/// KeyframeMapping says.
class Mapper {
 public:
  explicit Mapper(const MappingConfig& config) {
    if (config.method == MappingMethod::kCells) {
      cells_ = std::make_unique<MappingStage>(config);
    } else {
      keyframes_ = std::make_unique<KeyframeMapping>(config);
    }
  }

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept { cells_ ? cells_->finish(sweep) : keyframes_->finish(sweep); }
  void update(Sweep& sweep) noexcept {
    if (cells_) cells_->update(sweep);
  }
  void reset() noexcept { cells_ ? cells_->reset() : keyframes_->reset(); }

  const RefinedState& refined() const noexcept { return cells_ ? cells_->refined() : keyframes_->refined(); }

 private:
  std::unique_ptr<MappingStage> cells_;
  std::unique_ptr<KeyframeMapping> keyframes_;
};

}  // namespace pago::mapping
