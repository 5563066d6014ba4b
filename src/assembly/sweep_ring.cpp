// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/sweep_ring.hpp"

#include <cassert>

namespace pago {

SweepRing::SweepRing(std::size_t size, std::uint32_t max_returns) {
  assert(size > 0);
  sweeps_.reserve(size);
  for (std::size_t i = 0; i < size; ++i) sweeps_.emplace_back(max_returns);
}

Sweep* SweepRing::try_acquire() noexcept {
  if (in_flight() == sweeps_.size()) return nullptr;
  Sweep& sweep = sweeps_[acquired_++ % sweeps_.size()];
  sweep.recycle();
  return &sweep;
}

void SweepRing::release([[maybe_unused]] const Sweep* sweep) noexcept {
  assert(in_flight() > 0);
  assert(sweep == &sweeps_[released_ % sweeps_.size()]);
  ++released_;
}

}  // namespace pago
