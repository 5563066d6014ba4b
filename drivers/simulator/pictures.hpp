// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "scan_collector.hpp"

namespace pago::simulator {

/// Draws a scan into a folder, as PNG: bird.png (from above, 100 m square, by class), and as the sensor sees
/// it, the rear at both ends: classes.png, ranges.png, intensities.png. Throws Error when one cannot be
/// written.
void draw_scan(const LabelledRings& rings, const std::filesystem::path& folder);

}  // namespace pago::simulator
