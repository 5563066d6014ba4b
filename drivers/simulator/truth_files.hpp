// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "pago/simulator/simulator.hpp"

namespace pago::simulator {

/// Writes the drive's truth: see DriveFiles::truth. `until_ns` is where the drive was left, if early.
void write_truth(const Simulator& drive,
                 std::uint64_t num_sweeps,
                 std::int64_t until_ns,
                 const std::filesystem::path& tum);

}  // namespace pago::simulator
