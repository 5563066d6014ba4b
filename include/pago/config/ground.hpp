// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// [ground]
struct GroundConfig {
  std::string method = "patchwork";
};

template <typename Visitor>
void describe(Visitor& v, GroundConfig& c) {
  v("method", c.method, "ground segmentation, one of `pago segment --list`");
}

}  // namespace pago
