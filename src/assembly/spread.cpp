// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "spread.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace pago {

std::span<const int> Spreader::spread(std::span<const float> positions, int num_cells) noexcept {
  const auto n = static_cast<int>(positions.size());
  assert(positions.size() <= pools_.size() && n <= num_cells);
  // Cells that rise strictly are indices plus shifts that never fall: regress the shifts.
  std::size_t num_pools = 0;
  for (int i = 0; i < n; ++i) {
    const double shift = static_cast<double>(positions[static_cast<std::size_t>(i)]) - 0.5 - i;
    Pool pool{.sum = shift, .count = 1};
    while (num_pools > 0 &&
           pools_[num_pools - 1].sum * pool.count >= pool.sum * pools_[num_pools - 1].count) {
      const Pool& last = pools_[--num_pools];
      pool = {.sum = pool.sum + last.sum, .count = pool.count + last.count};
    }
    pools_[num_pools++] = pool;
  }
  int index = 0;
  for (std::size_t p = 0; p < num_pools; ++p) {
    const auto shift = static_cast<int>(std::lround(pools_[p].sum / pools_[p].count));
    const int bounded = std::clamp(shift, 0, num_cells - n);
    for (int k = 0; k < pools_[p].count; ++k, ++index)
      cells_[static_cast<std::size_t>(index)] = bounded + index;
  }
  return cells_.first(positions.size());
}

}  // namespace pago
