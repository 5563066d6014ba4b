// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace pago::kitti {

/// Between scans where nothing else tells: the mean of KITTI's odometry sequence 00 (9.65 Hz).
inline constexpr std::int64_t kNominalPeriodNs = 103'600'000;

/// times.txt of the odometry benchmark: seconds, one per line -> ns since the Unix epoch (kKittiEpochNs is
/// added). Throws Error with file and line.
std::vector<std::int64_t> read_seconds(const std::filesystem::path& file);

/// timestamps.txt of raw recordings: `2011-09-26 13:02:25.951199337` per line, taken as UTC -> ns since the
/// Unix epoch. Throws Error with file and line.
std::vector<std::int64_t> read_dates(const std::filesystem::path& file);

/// The rotation's duration around stamp `i`, from its neighbours; nominal where they are missing or tell of
/// no rotation between 4 and 25 Hz (pauses, repeated stamps).
std::int64_t period_ns(const std::vector<std::int64_t>& stamps_ns, std::size_t i);

}  // namespace pago::kitti
