// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/core/counters.hpp"
#include "pago/core/estimate.hpp"

namespace pago {

std::string_view to_string(Health health) noexcept {
  constexpr std::array<std::string_view, 4> kWords{"INIT", "OK", "DEGRADED", "LOST"};
  return kWords[static_cast<std::size_t>(health)];
}

std::string_view to_string(HealthReason reason) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(HealthReason::kCount)> kWords{
      "",
      "first sweep",
      "motion not known yet",
      "too few features",
      "motion not observable",
      "implausible motion",
      "not finite",
      "incomplete sweep",
      "time gap",
      "refused scan",
      "no data",
      "poor fit to the map",
      "local map begun anew",
      "cut short by the deadline"};
  return kWords[static_cast<std::size_t>(reason)];
}

std::string_view to_string(PacketFault fault) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(PacketFault::kCount)> kWords{
      "none", "size", "block flag", "azimuth", "stamp", "other sensor"};
  return kWords[static_cast<std::size_t>(fault)];
}

std::string_view to_string(SweepDrop drop) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(SweepDrop::kCount)> kWords{"no free sweep",
                                                                                             "superseded"};
  return kWords[static_cast<std::size_t>(drop)];
}

}  // namespace pago
