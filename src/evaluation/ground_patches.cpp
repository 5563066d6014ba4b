// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <array>
#include <bit>

#include "cell_planes.hpp"
#include "pago/evaluation/scan_statistics.hpp"

namespace pago::evaluation {
namespace {

constexpr double kSidePerRange = 0.2;
constexpr double kFewestInPatch = 12.0;
constexpr int kFewestRingsInPatch = 3;

struct Patch {
  CellSums sums;
  std::uint64_t rings = 0;  // a bit for each
};

}  // namespace

void add_ground_patches(const Sweep& sweep, ScanStatistics& statistics) {
  std::array<std::unordered_map<std::uint64_t, Patch>, kPatchBins.count> patches;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    if (sweep.ground[i] != kGround || (sweep.echo[i] & kNotStrongest) != 0) continue;
    const Eigen::Vector3d p(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    const std::size_t bin = kPatchBins.of(p.norm());
    if (bin == kPatchBins.count) continue;
    const double side_m = kSidePerRange * kPatchBins.from(bin + 1);
    Patch& patch = patches[bin][cell_key({p.x(), p.y(), 0.0}, side_m)];
    patch.sums.add(p);
    patch.rings |= std::uint64_t{1} << sweep.ring[i];
  }
  for (std::size_t bin = 0; bin < patches.size(); ++bin) {
    for (const auto& [key, patch] : patches[bin]) {
      const double n = patch.sums.n;
      if (n < kFewestInPatch || std::popcount(patch.rings) < kFewestRingsInPatch) continue;
      const double rms_m = std::sqrt(patch.sums.plane().variances[0] * n / (n - 3.0));
      statistics.patch_rms_m[bin].push_back(static_cast<float>(rms_m));
    }
  }
}

}  // namespace pago::evaluation
