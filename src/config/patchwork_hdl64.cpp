// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/config/ground/patchwork.hpp"

namespace pago {

PatchworkConfig patchwork_hdl64_profile() {
  return {};
}

}  // namespace pago
