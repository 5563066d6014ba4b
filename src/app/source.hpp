// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/kitti/kitti_source.hpp"

namespace pago::app {

/// Packets, with the calibration that they need.
struct OpenPackets {
  std::unique_ptr<PacketSource> packets;
  hdl64::Calibration calibration;
  bool is_live = false;
  std::vector<std::string> warnings;  ///< about the source, whole sentences
};
struct OpenFolder {
  std::unique_ptr<KittiSource> sweeps;
};
using OpenSource = std::variant<OpenPackets, OpenFolder>;

/// Opens what the user named: `udp://:2368`, `drive.pcap`, `kitti:sequences/00`; the prefixes pcap: and
/// kitti: may be left out, a folder is KITTI's and a file a capture. For a capture without a configured
/// calibration the one that lies beside it is taken, and set in `config`, so that what was used is on record.
/// Throws Error.
OpenSource open_source(const std::string& name, Config& config);

}  // namespace pago::app
