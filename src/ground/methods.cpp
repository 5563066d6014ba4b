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
      Method{"lego", "the slope between vertical neighbours (LeGO-LOAM, Shan and Englot 2018)", &make_lego},
  };
  return kMethods;
}

std::unique_ptr<Segmenter> make_segmenter(const GroundConfig& config,
                                          const Mount& mount,
                                          std::uint32_t max_returns) {
  const auto found = std::ranges::find(methods(), config.method, &Method::name);
  if (found != methods().end()) return found->make(config, mount, max_returns);

  std::string known;
  for (const Method& method : methods()) known += (known.empty() ? "" : ", ") + std::string(method.name);
  throw Error("ground.method", "no method is called '" + config.method + "'", "known: " + known);
}

}  // namespace pago::ground
