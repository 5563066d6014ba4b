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

/// A whole sweep at once.
template <Stage S>
void process(S& stage, Sweep& sweep) noexcept {
  stage.begin(sweep);
  stage.accept({&sweep, sweep.size, sweep.header.num_columns, true});
  stage.finish(sweep);
}

/// What a stage does once its result is out, as a stage of its own: its `update`, for each sweep that it has
/// finished. So the next stage, and whoever waits for the result, need not wait for it. Holds a reference.
template <typename S>
class Update {
 public:
  explicit Update(S& stage) : stage_(stage) {}

  void begin(Sweep&) noexcept {}
  void accept(const SweepPart&) noexcept {}
  void finish(Sweep& sweep) noexcept { stage_.update(sweep); }

 private:
  S& stage_;
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
  /// A whole sweep at once: each stage begins it when the one before has finished.
  void process(Sweep& sweep) noexcept {
    std::apply([&](auto&... stage) { (pago::process(stage, sweep), ...); }, stages_);
  }

 private:
  std::tuple<Stages&...> stages_;
};

}  // namespace pago
