// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/pipeline/sweep_reader.hpp"

namespace pago::app {

/// Packets, with the calibration that they need.
struct OpenPackets {
  std::unique_ptr<PacketSource> packets;
  hdl64::Calibration calibration;
  bool is_live = false;
  std::string calibration_note;       ///< where it was found, if the user did not say; else empty
  std::vector<std::string> warnings;  ///< about the source, whole sentences
};
struct OpenFolder {
  std::unique_ptr<KittiSource> sweeps;
};
using OpenSource = std::variant<OpenPackets, OpenFolder>;

/// The value of the setting hdl64.calibration for the one that the sensor sends itself (S2.1, S3).
inline constexpr const char* kSensorsOwn = "sensor";

/// The calibration that is configured; if none is, the one that lies beside `capture` (may be empty). Nothing
/// if the sensor's own is wanted, or left. Sets hdl64.calibration to what was decided, so that it is on
/// record, and `note` to words about it if the user did not decide. Throws Error.
std::optional<hdl64::Calibration> calibration_for(const std::filesystem::path& capture,
                                                  Config& config,
                                                  std::string& note);

/// Opens what the user named: `udp://:2368`, `drive.pcap`, `kitti:sequences/00`, `sim:urban,seed=3`; the
/// prefixes pcap: and kitti: may be left out, a folder is KITTI's and a file a capture. A sensor whose own
/// calibration is used must have sent all of it: captures are looked through, a live sensor is waited for.
/// Throws Error; also if the ground method of the configuration needs labels and the source has none.
OpenSource open_source(const std::string& name, Config& config);

/// The same of a recording, for tools that look at all of it; Error also for a live sensor.
OpenSource open_recording(const std::string& name, Config& config);
/// [set-up] Its sweeps; holds references to the source.
SweepReader reader_of(OpenSource& source, const Config& config);
Progress progress_of(const OpenSource& source);

/// Throws Error if this ground method needs labels and a sweep of the source will have none.
void require_labels(const OpenSource& source, const std::string& name, const std::string& method);

}  // namespace pago::app
