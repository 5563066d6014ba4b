// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "pago/config/config.hpp"
#include "pago/core/counters.hpp"
#include "pago/core/sources.hpp"
#include "pago/ground/mount_report.hpp"
#include "pago/hdl64/calibration.hpp"
#include "pago/output/decisions.hpp"
#include "pago/output/map_sweep.hpp"
#include "pago/output/pose_board.hpp"
#include "pago/output/sweep_record.hpp"
#include "pago/pipeline/run_status.hpp"

namespace pago {

/// How a run treats time.
enum class Pace : std::uint8_t {
  /// The source waits for the pipeline: nothing is dropped, and the outcome depends on the input and the
  /// configuration alone.
  kReplay,
  /// The pipeline keeps up with the source: where it cannot, whole sweeps are dropped, counted by cause;
  /// poses
  /// are published to other processes; threads ask for their real-time priorities.
  kLive
};

/// Learns what comes out of the pipeline while it runs, on the thread that called run(); not real-time. What
/// it throws ends the run and comes out of run().
class Observer {
 public:
  virtual ~Observer() = default;
  /// A sweep has gone through all stages. In order, one call for each sweep that was handed on.
  virtual void on_sweep(const output::SweepRecord& record) = 0;
  /// A keyframe, before the record of its sweep; valid during the call alone. Not called when no map is to be
  /// saved ([output.map]).
  virtual void on_map_sweep(const output::MapSweep&) {}
  /// Live runs: a pose was published (first and refined, for each sweep that has one).
  virtual void on_pose(const output::PoseV1&) {}
  /// Once, when the first sweeps have shown whether the ground is where the mount has it.
  virtual void on_mount(const ground::MountReport&) {}
  /// After each of the above, and at least ten times a second while nothing comes.
  virtual void on_status(const IngestStatus&) {}
};

/// How a run went. All counters are final and balanced.
struct RunSummary {
  SourceCounters source;   ///< packet runs only
  PacketCounters packets;  ///< packet runs only
  FiringCounters firings;  ///< packet runs only
  SweepCounters sweeps;
  std::uint64_t incomplete_sweeps = 0;  ///< posed, but more than 10 % of the rotation was missing
  std::uint64_t clock_restarts = 0;     ///< of the sensor's clock: power cycles, GPS found
  std::uint64_t requests = 0;           ///< of the assembler for an empty sweep
  std::uint64_t self_hits = 0;   ///< returns that were the vehicle's own body and left out; packet runs only
  std::uint64_t unrecorded = 0;  ///< live: sweeps and poses that the observer was too slow for
  std::uint64_t unmapped = 0;    ///< live: keyframes that the observer was too slow for
  std::string sensor;            ///< what the stream came from, e.g. "HDL-64E S2/S3, single return"
  hdl64::SensorStatus said;      ///< what the sensor says of itself; packet runs only
  std::vector<std::string> threads;  ///< what each thread asked for and got
  ground::MountReport mount;         ///< whether the ground was where the mount says
  std::string complaint;             ///< the source's own words if it ended early; what came before was used
  std::string failure;               ///< why the run could not be completed; empty if it was
  bool interrupted = false;

  bool balanced() const noexcept {
    return source.balanced() && packets.balanced() && firings.balanced() && sweeps.balanced();
  }
};

/// The way from packets or scans to poses, on three pinned threads (pipeline.cpp shows it in one screen).
/// Made once with everything it will need; runs once. [set-up] constructor and run() allocate and may throw
/// Error; the threads that run() starts allocate nothing.
class Pipeline {
 public:
  /// `as_recorded`: what a replay repeats of the live run whose packets it gets.
  explicit Pipeline(const Config& config, Pace pace = Pace::kReplay, output::Decisions as_recorded = {});
  ~Pipeline();

  /// Works until the source is exhausted or `stop` becomes true. Whoever has packets but no source puts a
  /// PacketInbox between.
  RunSummary run(PacketSource& source,
                 const hdl64::Calibration& calibration,
                 Observer& observer,
                 const std::atomic<bool>& stop);
  /// Replay alone: scans come from files.
  RunSummary run(SweepSource& source, Observer& observer, const std::atomic<bool>& stop);

  /// [any thread] While it runs: odometry begins anew at the next sweep, which defines `odom`. Real-time
  /// safe.
  void request_reset() noexcept;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace pago
