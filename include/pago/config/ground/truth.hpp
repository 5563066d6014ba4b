// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/describe.hpp"

namespace pago {

/// [ground.truth] The mask that a sweep's labels give (SemanticKITTI's classes): what a perfect method would
/// say.
struct TruthConfig {
  bool low_vegetation = false;
};

template <typename Visitor>
void describe(Visitor& v, TruthConfig& c) {
  v("low_vegetation", c.low_vegetation,
    "whether vegetation up to a quarter of mount.height_m above the ground counts as ground (Patchwork's "
    "protocol: true; Patchwork++ leaves it out)");
}

/// [ground.truth_errors] The truth with errors of known kind and rate, for studies of what errors do.
struct TruthErrorsConfig {
  double flip_rate = 0.01;
  double missed_patch_rate = 0.05;
  double taken_vegetation_rate = 0.05;
  double patch_m = 2.0;
  int seed = 1;
};

template <typename Visitor>
void describe(Visitor& v, TruthErrorsConfig& c) {
  v("flip_rate", c.flip_rate, within(0.0, 1.0), "part of the returns whose verdict is turned round");
  v("missed_patch_rate", c.missed_patch_rate, within(0.0, 1.0),
    "part of the patches of ground that are missed as a whole");
  v("taken_vegetation_rate", c.taken_vegetation_rate, within(0.0, 1.0),
    "part of the patches in which vegetation is taken for ground");
  v("patch_m", c.patch_m, within(0.1, 50.0), "side of the square patches of the two errors above");
  v("seed", c.seed, within(0, 2147483647),
    "another seed, other errors; a sweep's errors depend on its number too");
}

}  // namespace pago
