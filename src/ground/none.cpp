// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// No ground at all: what a study compares the other methods with.
#include <algorithm>

#include "methods.hpp"

namespace pago::ground {
namespace {

class NoGround final : public Segmenter {
 public:
  void finish(Sweep& sweep) noexcept override { std::fill_n(sweep.ground.begin(), sweep.size, kNonGround); }
};

}  // namespace

std::unique_ptr<Segmenter> make_none(const GroundConfig&, const Mount&, std::uint32_t) {
  return std::make_unique<NoGround>();
}

}  // namespace pago::ground
