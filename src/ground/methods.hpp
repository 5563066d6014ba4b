// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/ground/segmenter.hpp"

/// One factory per method, each in the method's own file; the table in methods.cpp lists them. All are
/// [set-up], throw Error on settings that contradict each other, and allocate for up to `max_returns`.
namespace pago::ground {

using MakeSegmenter = std::unique_ptr<Segmenter>(const GroundConfig&,
                                                 const Mount&,
                                                 std::uint32_t max_returns);

MakeSegmenter make_cascaded, make_gpf, make_lego, make_linefit, make_none, make_patchwork,
    make_patchwork_hdl64, make_patchworkpp, make_ransac, make_rgpf, make_truth, make_truth_errors;

}  // namespace pago::ground
