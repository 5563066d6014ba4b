// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/calibration.hpp"

namespace pago::perf {

/// A recorded drive in memory, so that no measurement waits for a disk.
struct Drive {
  Config config;  ///< the defaults, and the drive's calibration
  hdl64::Calibration calibration;
  std::vector<Datagram> datagrams;  ///< payloads lie in `bytes`
  std::vector<std::uint8_t> bytes;
  std::size_t num_sweeps = 0;   ///< whole ones
  std::size_t sweep_bytes = 0;  ///< that the assembler writes into one of them, on average
};

/// $PAGO_DATA/packets/drive_0005 (KITTI raw 2011_09_26_drive_0005 as packets); nothing if it is not there.
/// Throws Error if it is, but cannot be read or is not of the sensor.
std::optional<Drive> load_drive();

}  // namespace pago::perf
