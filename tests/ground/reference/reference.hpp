// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "pago/config/ground.hpp"
#include "pago/core/mount.hpp"
#include "pago/core/sweep.hpp"

/// Every method as its paper and spec tell it, in double precision, with sorting, lists and arctangents, and
/// without any thought for speed: what the optimised methods are held against.
namespace pago::test {

using Mask = std::vector<std::uint8_t>;
/// The mask of a sweep; may remember the sweeps before.
using Reference = std::function<Mask(const Sweep&)>;

/// What authors' codes do otherwise: to measure how much it accounts for.
enum class LowReturns { kTested, kLeftOut };  ///< whether what is too low to start a plane is held against it
enum class WideGap {
  kBridged,
  kEndsPairs
};  ///< kEndsPairs: a line of two returns stops at it, whatever follows

Reference cascaded_reference(const CascadedConfig&, const Mount&);
Reference gpf_reference(const GpfConfig&, const Mount&, LowReturns = LowReturns::kTested);
Reference lego_reference(const LegoConfig&, const Mount&);
Reference linefit_reference(const LinefitConfig&, const Mount&, WideGap = WideGap::kBridged);
Reference patchwork_reference(const PatchworkConfig&, const Mount&);
Reference patchworkpp_reference(const PatchworkppConfig&, const Mount&);
Reference ransac_reference(const RansacConfig&, const Mount&);
Reference rgpf_reference(const RgpfConfig&, const Mount&);

/// Of the method named in the configuration; empty for those that are no more than a look-up (none, truth).
Reference make_reference(const GroundConfig&, const Mount&);

/// Share of the returns on which two masks of a sweep differ.
double share_different(const Sweep& sweep, const Mask& reference);

}  // namespace pago::test
