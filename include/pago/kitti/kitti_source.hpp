// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "pago/assembly/scan_organizer.hpp"
#include "pago/config/drivers.hpp"
#include "pago/core/sources.hpp"

namespace pago {

/// Columns of a KITTI scan's range image: one speed of rotation for all of its recordings.
inline constexpr int kKittiColumns = kScanColumns;

/// Seconds in KITTI's times.txt count from here: midnight (UTC) of the day of the first recordings,
/// 2011-09-26.
inline constexpr std::int64_t kKittiEpochNs = 1'316'995'200'000'000'000;

/// Reads folders of KITTI scans (Geiger et al. 2013), one sweep per file, in the order of the file numbers:
///   odometry benchmark   FOLDER/velodyne/000000.bin ...   stamps FOLDER/times.txt (seconds)
///   raw recordings       FOLDER/velodyne_points/data/0000000000.bin ...   stamps .../timestamps.txt (dates)
/// or the innermost folder itself. Without a stamp file the stamps are 103.6 ms apart. SemanticKITTI's labels
/// lie in a folder labels/ beside velodyne/ (or velodyne_points/, or data/), 000000.label for 000000.bin.
///
/// What a file's points become (little-endian float32 x, y, z, intensity each):
/// - points, ring, column: as ScanOrganizer says, in file order; masks have one byte per point.
///   scans_with_guessed_rings() counts files that do not go ring by ring as KITTI's do.
/// - intensity: [0, 1] becomes 0-255; files that hold 0-255 are recognised and kept.
/// - time: stamps are mid-scan, the rotation lasts from half a period before to half a period after. Returns
///   of uncompensated scans get the time of their azimuth; others get zero, and the sweep kCompensated.
/// - label: the class, and the sweep kLabelled, where there is a file of labels.
/// - header.sequence counts file numbers, so that missing files leave a gap (and kAfterGap). The last scan of
///   a raw recording is often cut short: below 90 % of a rotation it is kPartialEnd.
///
/// [set-up] the constructor; [ingest thread] all the rest. fill() reads a file, else it is real-time safe.
class KittiSource final : public SweepSource {
 public:
  /// More points than this in a file are refused: 5 Hz dual return.
  static constexpr std::size_t kMaxPoints = 460'800;

  /// Throws Error if there are no scans, or the stamp file is damaged or does not match them.
  explicit KittiSource(const std::filesystem::path& folder,
                       const KittiConfig& config = {},
                       const SelfFilter& self = {});
  ~KittiSource() override;

  bool fill(Sweep& sweep) noexcept override;
  /// In scans.
  Progress progress() const noexcept override;
  /// A file that cannot be read, is empty, has too many points or ends inside one, or labels that are not one
  /// for each point. [any but the hot path]
  std::string complaint() const override;

  /// Whether the sweeps are flagged kCompensated (config, or by the layout).
  bool is_compensated() const noexcept;
  /// False: no stamp file was found.
  bool has_stamps() const noexcept;
  /// The first scan that has no file of labels; empty if all have. [any but the hot path]
  std::string first_without_labels() const;
  /// File numbers between the first scan and the last that have no file.
  std::uint64_t missing_scans() const noexcept;
  /// Scans so far whose rings are not certain.
  std::uint64_t scans_with_guessed_rings() const noexcept;
  /// Points so far that were the vehicle's own body.
  std::uint64_t self_hits() const noexcept;
  /// Returns so far that found no cell: more than kKittiColumns in one ring.
  std::uint64_t returns_without_cell() const noexcept;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
