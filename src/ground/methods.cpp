// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "methods.hpp"

#include <algorithm>
#include <array>

#include "pago/core/error.hpp"

namespace pago::ground {

std::span<const Method> methods() noexcept {
  static constexpr std::array kMethods{
      Method{"patchwork", "a plane per polar bin, judged by tilt, height and flatness (Lim 2021)",
             &make_patchwork},
      Method{"patchwork-hdl64", "Patchwork with settings chosen for the HDL-64E", &make_patchwork_hdl64},
      Method{"patchworkpp",
             "Patchwork that learns its bounds from the sweeps before (Lee 2022)",
             &make_patchworkpp,
             {.has_memory = true}},
      Method{"lego", "the slope between vertical neighbours (LeGO-LOAM, Shan and Englot 2018)", &make_lego},
      Method{"rgpf", "a plane per polar bin, not judged (ERASOR, Lim 2021)", &make_rgpf},
      Method{"linefit", "lines along each azimuth (Himmelsbach 2010)", &make_linefit},
      Method{"ransac", "the plane that most returns lie on", &make_ransac},
      Method{"gpf", "one plane, or three, grown from the lowest returns (Zermas 2017)", &make_gpf},
      Method{"cascaded", "obstacles by ring spacing, then a plane per region (Narksri 2018)", &make_cascaded},
      Method{"none", "no ground; for studies", &make_none},
      Method{"truth", "what the labels say; for studies", &make_truth, {.needs_labels = true}},
      Method{"truth-errors",
             "what the labels say, with errors put in; for studies",
             &make_truth_errors,
             {.needs_labels = true}},
  };
  return kMethods;
}

const Method& find_method(std::string_view name) {
  const auto found = std::ranges::find(methods(), name, &Method::name);
  if (found != methods().end()) return *found;

  std::string known;
  for (const Method& method : methods()) known += (known.empty() ? "" : ", ") + std::string(method.name);
  throw Error("ground.method", "no method is called '" + std::string(name) + "'", "known: " + known);
}

std::unique_ptr<Segmenter> make_segmenter(const GroundConfig& config,
                                          const Mount& mount,
                                          std::uint32_t max_returns) {
  return find_method(config.method).make(config, mount, max_returns);
}

}  // namespace pago::ground
