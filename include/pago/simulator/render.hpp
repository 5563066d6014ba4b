// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

#include "pago/config/config.hpp"
#include "pago/core/sources.hpp"

namespace pago::simulator {

/// Files that a drive is written to; those whose path is empty are left out. Existing ones are overwritten;
/// Error when one is named twice.
struct DriveFiles {
  std::filesystem::path pcap;
  std::filesystem::path labels;       ///< of the packets' slots: simulator/packet_labels.hpp
  std::filesystem::path calibration;  ///< db.xml of the unit
  /// TUM, T_world_sensor at 200 Hz on the sensor's clock; beside it, per sweep, NAME_start.txt, NAME_mid.txt
  /// and NAME_end.txt (KITTI rows, row i for sweep i) and NAME_times.txt (start, mid and end in seconds).
  std::filesystem::path truth;
  /// A folder as of KITTI's odometry benchmark with SemanticKITTI's labels: velodyne/, labels/, times.txt,
  /// poses.txt (of the camera, mid-sweep), calib.txt.
  std::filesystem::path kitti;
  std::filesystem::path
      pictures;  ///< a folder: the drive's middle scan as PNG, from above and as the sensor sees it
  bool kitti_compensated = false;  ///< scans in the frame of their middle, as the benchmark's are; else raw
};

/// Renders the drive of config.simulator to files. Faults of the way to the host are in the capture only:
/// labels, truth and scans are of what the sensor sent. `on_progress` is called a few times a second with
/// packets done; `stop` ends early with the files complete so far. Returns the number of whole sweeps. Throws
/// Error for settings that cannot be used and files that cannot be written. [set-up] one thread; 10 sweeps
/// take about a second.
std::uint64_t render(const Config& config,
                     const DriveFiles& files,
                     const std::function<void(const Progress&)>& on_progress,
                     const std::atomic<bool>& stop);

/// The same files with their usual names in one folder: packets.pcap, packets.labels, calibration.xml,
/// truth.tum and its companions.
DriveFiles files_in(const std::filesystem::path& folder);

/// What cached_drive() lets a cache grow to: about an hour of packets with labels.
inline constexpr std::uintmax_t kMostCached_bytes = 20'000'000'000;

/// The drive of config.simulator, rendered into `cache` unless it is there already. What counts are the
/// settings that shape the drive (simulator, mount, and of hdl64 what packets depend on), the contents of
/// files they name, and the sources that it is rendered by; so a stale drive is never used. Folders appear
/// when they are complete; one that files are missing from is rendered anew. Before a new drive, those that
/// were used longest ago are removed until the rest is within `most_bytes`, and what killed processes left.
std::filesystem::path cached_drive(const Config& config,
                                   const std::filesystem::path& cache,
                                   const std::function<void(const Progress&)>& on_progress,
                                   const std::atomic<bool>& stop,
                                   std::uintmax_t most_bytes = kMostCached_bytes);
/// $XDG_CACHE_HOME/pago/drives or ~/.cache/pago/drives. Error when neither variable is set.
std::filesystem::path default_cache();

}  // namespace pago::simulator
