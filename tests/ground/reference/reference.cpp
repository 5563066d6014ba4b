// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/ground/reference/reference.hpp"

namespace pago::test {

Reference make_reference(const GroundConfig& c, const Mount& mount) {
  if (c.method == "cascaded") return cascaded_reference(c.cascaded, mount);
  if (c.method == "gpf") return gpf_reference(c.gpf, mount);
  if (c.method == "lego") return lego_reference(c.lego, mount);
  if (c.method == "linefit") return linefit_reference(c.linefit, mount);
  if (c.method == "patchwork") return patchwork_reference(c.patchwork, mount);
  if (c.method == "patchwork-hdl64") return patchwork_reference(c.patchwork_hdl64, mount);
  if (c.method == "patchworkpp") return patchworkpp_reference(c.patchworkpp, mount);
  if (c.method == "ransac") return ransac_reference(c.ransac, mount);
  if (c.method == "rgpf") return rgpf_reference(c.rgpf, mount);
  return {};
}

}  // namespace pago::test
