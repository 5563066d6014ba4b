// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pago/config/ground/cascaded.hpp"
#include "pago/config/ground/gpf.hpp"
#include "pago/config/ground/lego.hpp"
#include "pago/config/ground/linefit.hpp"
#include "pago/config/ground/mount_check.hpp"
#include "pago/config/ground/patchwork.hpp"
#include "pago/config/ground/patchworkpp.hpp"
#include "pago/config/ground/ransac.hpp"
#include "pago/config/ground/rgpf.hpp"
#include "pago/config/ground/truth.hpp"

namespace pago {

/// [ground]
struct GroundConfig {
  std::string method = "patchwork";
  PatchworkConfig patchwork;
  PatchworkConfig patchwork_hdl64 = patchwork_hdl64_profile();
  PatchworkppConfig patchworkpp;
  LegoConfig lego;
  RgpfConfig rgpf;
  LinefitConfig linefit;
  RansacConfig ransac;
  GpfConfig gpf;
  CascadedConfig cascaded;
  TruthConfig truth;
  TruthErrorsConfig truth_errors;
  MountCheckConfig mount_check;
  HeightEstimateConfig height;
};

template <typename Visitor>
void describe(Visitor& v, GroundConfig& c) {
  v("method", c.method,
    "ground segmentation: patchwork, patchwork-hdl64, patchworkpp, lego, rgpf, linefit, ransac, gpf, "
    "cascaded; none, truth or "
    "truth-errors for studies");
  v.section("patchwork", c.patchwork,
            "a plane per polar bin, judged by tilt, height and flatness (Lim 2021)");
  v.section("patchwork_hdl64", c.patchwork_hdl64, "Patchwork with settings chosen for the HDL-64E");
  v.section("patchworkpp", c.patchworkpp,
            "Patchwork that learns its bounds from the sweeps before (Lee 2022)");
  v.section("lego", c.lego, "the slope between vertical neighbours (Shan and Englot 2018)");
  v.section("rgpf", c.rgpf, "a plane per polar bin, not judged (Lim 2021, ERASOR)");
  v.section("linefit", c.linefit, "lines along each azimuth (Himmelsbach 2010)");
  v.section("ransac", c.ransac, "the plane that most returns lie on");
  v.section("gpf", c.gpf, "one plane, or three, grown from the lowest returns (Zermas 2017)");
  v.section("cascaded", c.cascaded, "obstacles by ring spacing, then a plane per region (Narksri 2018)");
  v.section("truth", c.truth, "the labels' own mask");
  v.section("truth_errors", c.truth_errors, "the labels' own mask with errors put in");
  v.section("mount_check", c.mount_check, "whether the ground lies where the mount says");
  v.section("height", c.height, "the sensor's height from the first sweep instead of the mount");
}

}  // namespace pago
