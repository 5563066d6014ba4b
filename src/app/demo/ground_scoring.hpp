// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "pago/config/config.hpp"
#include "pago/evaluation/ground_metrics.hpp"
#include "pago/hdl64/calibration.hpp"

namespace pago::app {

/// How well the configured ground module does on a simulated drive: its packets are read again, and each
/// sweep's mask is held against the labels. [set-up] a few seconds.
evaluation::GroundSummary score_ground(const Config& config,
                                       const hdl64::Calibration& calibration,
                                       const std::filesystem::path& pcap,
                                       const std::filesystem::path& labels,
                                       evaluation::GroundProtocol protocol);

}  // namespace pago::app
