// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "pago/core/aligned_array.hpp"
#include "pago/core/estimate.hpp"
#include "pago/core/range_image.hpp"
#include "pago/core/units.hpp"

namespace pago {

/// Where a sweep's time goes. One entry per row of the latency table.
enum class StageId : std::uint8_t { kIngest, kGround, kFeatures, kOdometry, kMapping, kUpdate, kCount };
inline constexpr std::size_t kNumStages = static_cast<std::size_t>(StageId::kCount);

/// One stage's time on one sweep. Monotonic clock; zero where the stage did not run.
struct StageTime {
  std::int64_t start_ns = 0, end_ns = 0;
  std::int64_t cpu_ns = 0;  ///< thread CPU time spent inside the stage
};

/// What can be the matter with a sweep; bits of SweepHeader::flags.
enum SweepFlag : std::uint32_t {
  kPartialStart = 1U << 0,  ///< the stream began in it, less than 90 % of a rotation: no pose
  kPartialEnd = 1U << 1,    ///< the stream ended in it, less than 90 % of a rotation: no pose
  kIncomplete = 1U << 2,    ///< inside the run, but more than 10 % of the rotation is missing
  kAfterGap = 1U << 3,      ///< whole rotations are missing between it and its predecessor
  kOverfull = 1U << 4,      ///< closed early because its arrays were full
  kCompensated =
      1U << 5,            ///< returns are already in the frame of one instant (KITTI odometry): never de-skew
  kSuperseded = 1U << 6,  ///< skipped for a newer one under overload: no pose
  kAfterReset = 1U << 8,  ///< odometry began anew ahead of it, because somebody asked
  kLabelled = 1U << 7,    ///< `label` holds the truth: simulated or hand-labelled
};

struct SweepHeader {
  std::uint64_t sequence = 0;  ///< counts rotations from 0, skipped and partial ones included
  std::uint64_t request =
      0;  ///< which of the assembler's requests for an empty sweep it was given for, from 1
  std::int64_t start_ns = 0;  ///< sensor time of the first firing, ns since the Unix epoch
  std::int64_t end_ns = 0;    ///< sensor time of the end of the last firing
  /// What to add to sensor time for the time of day (hdl64/clock_offset.hpp). Differences of sensor times are
  /// exact; this one follows the host's clock, and steps when that is set. 0 where GPS keeps the sensor's.
  std::int64_t clock_offset_ns = 0;
  std::int64_t first_arrival_ns = 0, last_arrival_ns = 0;  ///< host arrival of its first and last packet
  std::int64_t closed_ns = 0;  ///< monotonic clock when the assembler handed it on
  /// Monotonic clock when its last packet arrived, as well as the host's clock tells (last_arrival_ns); in a
  /// replay, where arrival was long ago: closed_ns. Latency counts from here.
  std::int64_t complete_ns = 0;
  std::uint32_t num_columns = 0;  ///< firings in the rotation = used columns of the range image
  std::uint32_t firings_received = 0, firings_lost = 0;
  std::uint32_t firings_blind = 0;  ///< never sent: the sensor's field of view is limited
  std::uint32_t packets_bad = 0;    ///< malformed datagrams that arrived while it was filled
  float rotation_rev = 0.0F;        ///< how far the head turned, in revolutions: 1 for a whole sweep
  std::uint32_t flags = 0;          ///< SweepFlag bits

  bool has(SweepFlag flag) const noexcept { return (flags & flag) != 0; }
  bool is_posed() const noexcept { return (flags & (kPartialStart | kPartialEnd | kSuperseded)) == 0; }
};

/// What a return is among those that one laser had of one firing; bits of Sweep::echo. 0 is the strongest and
/// the last in one: a laser's only return, and all of a sensor in single-return mode.
enum Echo : std::uint8_t {
  kNotLast = 1U << 0,  ///< a farther return was weaker
  kNotStrongest =
      1U << 1  ///< dual return only: a stronger return came with it, and has their range image's cell
};

/// Ground mask values.
inline constexpr std::uint8_t kNonGround = 0;
inline constexpr std::uint8_t kGround = 1;

/// Cluster labels (features/clustering.hpp): 0 ground, >= 1 a valid segment, kClutter too small to trust.
inline constexpr std::uint16_t kClutter = 0xFFFF;

/// What the features stage adds: indices into the sweep's arrays.
struct FeatureLists {
  FixedVector<std::uint32_t> sharp_edges;   ///< the sharpest few per sector: sources of step two
  FixedVector<std::uint32_t> edges;         ///< sharp ones and more: the next sweep's targets
  FixedVector<std::uint32_t> flat_planars;  ///< the flattest few per sector: sources of step one
  FixedVector<std::uint32_t> planars;       ///< thinned rest: the next sweep's targets
  FixedVector<std::uint32_t> outliers;      ///< of segments too small to trust, where asked for
  /// Edges and planars come row by row of the image that they were found in: row r is [rows[r], rows[r + 1]).
  std::array<std::uint32_t, kNumRings + 1> edge_rows{}, planar_rows{};
  // Of all returns, whatever they are (features/thinning.hpp); each list is a part of the one before.
  FixedVector<std::uint32_t> dense;       ///< evenly spaced along rings: what a saved map shows
  FixedVector<std::uint32_t> map_points;  ///< one per voxel: what the local map is made of
  FixedVector<std::uint32_t> key_points;  ///< few: what is registered to the local map
};
/// More than a sweep of an HDL-64E gives at the default voxels, with room to spare; beyond, points are left
/// out.
inline constexpr std::uint32_t kMaxDensePoints = 100'000, kMaxMapPoints = 32'768, kMaxKeyPoints = 8'000,
                               kMaxOutliers = 65'536;

/// What odometry tells mapping: the motion since the last sweep with a pose, between the two sweeps'
/// reference instants. Poses are chained between these; they are reported at the configured instant.
struct ScanMotion {
  std::int64_t reference_ns = 0;  ///< the sweep's middle
  std::int64_t reported_ns = 0;
  double period_s = 0.0;        ///< since the last sweep's reference instant; 0 for the first sweep
  bool is_compensated = false;  ///< returns are in the frame of the reference instant already
  bool is_registered = false;   ///< found by matching; else carried on at constant velocity
  bool is_time_lost = false;    ///< the sensor's clock began anew, or leapt: `period_s` is a guess
  Eigen::Isometry3d T_last_this = Eigen::Isometry3d::Identity();
  /// Of T_last_this; right perturbation in the sensor frame, order x y z roll pitch yaw.
  Matrix6d information = Matrix6d::Zero();
};

/// What mapping leaves for odometry's next sweep: the last one, once the map had its say. Both live in the
/// estimate thread.
struct RefinedState {
  bool is_placed = false;   ///< the pose below is one
  bool has_motion = false;  ///< it is known how the sensor moves
  bool is_of_map = false;   ///< sweeps are registered to a map; else this is odometry's own, carried on
  Eigen::Isometry3d T_odom_reference = Eigen::Isometry3d::Identity();  ///< at the reference instant
  Vector6d twist = Vector6d::Zero();  ///< per second, sensor frame, mean over the last period
  /// Of that twist; so that twist_at() holds half way from the reference instant to the sweep's end, where
  /// poses are carried from the one to the other.
  Vector6d acceleration = Vector6d::Zero();
  double period_s = 0.0;  ///< the last one

  /// The twist at an instant so long after the reference instant: best half way to the sweep's end.
  Vector6d twist_at(double after_s) const noexcept {
    return twist + (0.5 * period_s + after_s) * acceleration;
  }
};

/// One rotation of the sensor, the frame that travels through the pipeline. Preallocated, structure of
/// arrays; made once, filled and recycled by the SweepRing (assembly/sweep_ring.hpp). Each stage writes only
/// its own part; none reorders or copies returns, so a mask stays one byte per input point.
///
/// Frame `sensor`: x forward, y left, z up (REP-103), metres. [set-up] the constructor allocates; the rest is
/// data.
struct Sweep {
  explicit Sweep(std::uint32_t max_returns)
      : x_m(max_returns),
        y_m(max_returns),
        z_m(max_returns),
        intensity(max_returns),
        ring(max_returns),
        echo(max_returns),
        column(max_returns),
        time_offset_ns(max_returns),
        label(max_returns),
        ground(max_returns),
        cluster(max_returns) {
    // Selection takes at most 20 edges and 4 flat points from each of 6 sectors of a ring (LeGO-LOAM's
    // numbers).
    features.sharp_edges = FixedVector<std::uint32_t>(kNumRings * 6 * 20);
    features.edges = FixedVector<std::uint32_t>(kNumRings * 6 * 40);
    features.flat_planars = FixedVector<std::uint32_t>(kNumRings * 6 * 20);
    features.planars = FixedVector<std::uint32_t>(max_returns);
    features.outliers = FixedVector<std::uint32_t>(std::min(max_returns, kMaxOutliers));
    features.dense = FixedVector<std::uint32_t>(std::min(max_returns, kMaxDensePoints));
    features.map_points = FixedVector<std::uint32_t>(std::min(max_returns, kMaxMapPoints));
    features.key_points = FixedVector<std::uint32_t>(std::min(max_returns, kMaxKeyPoints));
  }

  SweepHeader header;

  // --- assembler: returns in arrival order, [0, size). Dual return: a firing's strongest first, then what
  // its lasers saw besides. The range image holds the strongest only, so what works on it sees nothing twice.
  std::uint32_t size = 0;
  AlignedArray<float> x_m, y_m, z_m;
  AlignedArray<std::uint8_t> intensity;
  AlignedArray<std::uint8_t> ring;  ///< 0 lowest, by this unit's vertical angles
  AlignedArray<std::uint8_t> echo;  ///< Echo bits
  AlignedArray<std::uint16_t> column;
  AlignedArray<std::int32_t> time_offset_ns;  ///< firing time after header.start_ns
  RangeImage range_image;
  /// So many columns of the range image, and the margins beside them, may still be of an earlier use.
  int stale_columns = 0;
  AlignedArray<std::uint16_t> label;  ///< SemanticKITTI class, where header.flags has kLabelled

  // --- ground
  AlignedArray<std::uint8_t> ground;  ///< kGround or kNonGround per return

  // --- features
  AlignedArray<std::uint16_t> cluster;
  FeatureLists features;

  // --- odometry
  ScanMotion motion;

  // --- odometry, mapping
  Estimate estimate;

  // --- runner
  std::array<StageTime, kNumStages> times{};

  /// How long before the reference instant of `motion` a return was fired, in seconds; may be negative. 0 in
  /// a compensated sweep.
  float before_reference_s(std::uint32_t i) const noexcept {
    if (motion.is_compensated) return 0.0F;
    return static_cast<float>(seconds(motion.reference_ns - header.start_ns - time_offset_ns[i]));
  }

  std::uint32_t capacity() const noexcept { return static_cast<std::uint32_t>(x_m.size()); }
  StageTime& time_of(StageId stage) noexcept { return times[static_cast<std::size_t>(stage)]; }
  const StageTime& time_of(StageId stage) const noexcept { return times[static_cast<std::size_t>(stage)]; }

  /// Makes the sweep empty for refilling; keeps the memory.
  void reset() noexcept {
    recycle();
    clear_stale_columns();
  }

  /// The same, but for the range image: who fills it column by column writes most of it anyway, and empties
  /// the rest of the stale columns before anybody else sees the sweep.
  void recycle() noexcept {
    stale_columns = std::max(stale_columns, static_cast<int>(header.num_columns));
    header = {};
    size = 0;
    features.sharp_edges.clear();
    features.edges.clear();
    features.flat_planars.clear();
    features.planars.clear();
    features.outliers.clear();
    features.edge_rows = features.planar_rows = {};
    features.dense.clear();
    features.map_points.clear();
    features.key_points.clear();
    motion = {};
    estimate = {};
    times = {};
  }

  /// After recycle(): empties the range image.
  void clear_stale_columns() noexcept { range_image.clear(std::exchange(stale_columns, 0)); }
};

}  // namespace pago
