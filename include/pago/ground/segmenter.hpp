// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "pago/config/ground.hpp"
#include "pago/core/mount.hpp"
#include "pago/core/stage.hpp"

namespace pago::ground {

/// Ground segmentation: decides for every return of a sweep whether the vehicle could stand on what it hit.
/// Satisfies Stage: `finish` leaves ground[i] = kGround or kNonGround for every i < size, and writes nothing
/// else. Returns that are zero or not finite are non-ground. Parts given to `accept` only move work forward:
/// the mask is the same with any of them, or none. [front thread] everything: real-time safe, noexcept,
/// deterministic; a sweep must not hold more returns than the segmenter was made for.
///
/// Coordinates are the sensor's; methods level them by the mount's roll and pitch, and expect the ground
/// mount.height_m below the sensor. Settings, with units, ranges and sources: config/ground.hpp.
class Segmenter {
 public:
  virtual ~Segmenter() = default;
  virtual void begin(Sweep&) noexcept {}
  virtual void accept(const SweepPart&) noexcept {}
  virtual void finish(Sweep& sweep) noexcept = 0;

  /// Between sweeps: forgets what earlier sweeps taught, as if just made. Most methods learn nothing.
  virtual void reset() noexcept {}
  /// Between sweeps: another height of the sensor than the mount's, as if made for it.
  virtual void set_height(double /*height_m*/) noexcept {}
};

/// What a user of a method has to know about it.
struct MethodTraits {
  bool has_memory = false;    ///< the mask depends on the sweeps before: see Segmenter::reset()
  bool needs_labels = false;  ///< sweeps must be labelled (SweepFlag::kLabelled); in others nothing is ground
};

/// One row per method; adding a method is one file and one row (src/ground/methods.cpp).
struct Method {
  std::string_view name;     ///< as in `--ground NAME`
  std::string_view summary;  ///< one line for help: idea, paper
  /// [set-up] Allocates for sweeps of up to `max_returns`.
  std::unique_ptr<Segmenter> (*make)(const GroundConfig&, const Mount&, std::uint32_t max_returns);
  MethodTraits traits{};
};

std::span<const Method> methods() noexcept;

/// [set-up] The method of that name. Throws Error that lists the known ones.
const Method& find_method(std::string_view name);

/// [set-up] The method named in the configuration. Throws Error as find_method().
std::unique_ptr<Segmenter> make_segmenter(const GroundConfig&, const Mount&, std::uint32_t max_returns);

}  // namespace pago::ground
