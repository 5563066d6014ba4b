// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <cstdint>
#include <tuple>

#include "pago/core/sweep.hpp"

namespace pago {

/// A stretch of a sweep that is final, so that work can begin before the rotation ends. Parts of one sweep
/// arrive in order and cover it; whole-sweep operation is one part with `last` set.
struct SweepPart {
  Sweep* sweep = nullptr;
  std::uint32_t returns_until = 0;  ///< returns [0, returns_until) are written
  std::uint32_t columns_until = 0;  ///< no later return falls into columns [kColumnMargin, columns_until)
  bool last = false;                ///< header and range image are final too
};

/// A step of the pipeline. Created with everything it will ever need ([set-up], may throw and allocate);
/// afterwards called by one thread, for each sweep `begin`, one or more `accept`, `finish`. No call may
/// allocate, lock, log, throw or touch a file, and none may read what a later stage writes.
template <typename S>
concept Stage = requires(S& stage, Sweep& sweep, const SweepPart& part) {
  { stage.begin(sweep) }
  noexcept->std::same_as<void>;
  { stage.accept(part) }
  noexcept->std::same_as<void>;
  { stage.finish(sweep) }
  noexcept->std::same_as<void>;
};

/// Stages that share a thread, in order; itself a stage. Holds references: the stages must outlive it.
template <Stage... Stages>
class Chain {
 public:
  explicit Chain(Stages&... stages) : stages_(stages...) {}

  void begin(Sweep& sweep) noexcept {
    std::apply([&](auto&... stage) { (stage.begin(sweep), ...); }, stages_);
  }
  void accept(const SweepPart& part) noexcept {
    std::apply([&](auto&... stage) { (stage.accept(part), ...); }, stages_);
  }
  void finish(Sweep& sweep) noexcept {
    std::apply([&](auto&... stage) { (stage.finish(sweep), ...); }, stages_);
  }

 private:
  std::tuple<Stages&...> stages_;
};

}  // namespace pago
