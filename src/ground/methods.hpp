// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/ground/segmenter.hpp"

/// One factory per method, each in the method's own file; the table in methods.cpp lists them. All are
/// [set-up], throw Error on settings that contradict each other, and allocate for up to `max_returns`.
namespace pago::ground {

std::unique_ptr<Segmenter> make_lego(const GroundConfig&, const Mount&, std::uint32_t max_returns);
std::unique_ptr<Segmenter> make_patchwork(const GroundConfig&, const Mount&, std::uint32_t max_returns);

}  // namespace pago::ground
