// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>

#include "pago/assembly/sweep_exchange.hpp"
#include "pago/config/assembly.hpp"
#include "pago/hdl64/packet_decoder.hpp"

namespace pago {

/// One firing as the assembler sees it.
struct Firing {
  std::int64_t time_ns = 0;     ///< sensor time of its start
  std::int64_t arrival_ns = 0;  ///< of its packet, host clock
  double revolutions = 0.0;     ///< unwrapped encoder azimuth at its start, clockwise
  double rate_rev_s = 0.0;      ///< above 0
  bool is_after_blind = false;  ///< what is missing before it was never sent: the field of view is limited
};

/// Every rotation that was begun has one fate: opened = handed_on + no_free_sweep + is_open.
struct AssemblyCounters {
  std::uint64_t opened = 0, handed_on = 0, no_free_sweep = 0, is_open = 0;
  std::uint64_t partial = 0, incomplete = 0, overfull = 0;  ///< of those handed on, by flag
  bool balanced() const noexcept { return opened == handed_on + no_free_sweep + is_open; }
};

/// Fills sweeps: the returns in order of arrival, and the range image, ring x column, over them.
///
/// A column is a firing's place in the sweep, counted from the cut azimuth and shifted for each laser by
/// -round(rotCorrection / azimuth step), so that a column's returns lie in one direction; what runs over
/// either end of the rotation is wrapped around it when the sweep closes. One firing, one cell: no return is
/// lost and none shares a cell. Lost firings leave their columns empty, by device time, so that columns keep
/// their angles.
///
/// A sweep ends at the firing nearest to the cut azimuth. Whatever happens to the stream, each rotation of
/// the head gives at most one sweep, and the sequence number counts rotations:
///  - less than 90 % of a rotation at the start or end of the stream: kPartialStart, kPartialEnd;
///  - less than 90 % of the firings received otherwise (of those that were sent): kIncomplete;
///  - rotations without any firing before it: kAfterGap;
///  - no room for another firing (slower than 5 Hz, or more returns than max_returns): kOverfull; it is
///  closed
///    and the rest of that rotation is ignored;
///  - no free sweep at a cut: the sweep just filled is emptied and filled anew (its rotation is given up and
///    counted), unless parts of it have been handed on already; then the coming rotation is given up.
///
/// [set-up] constructor; [ingest thread] the rest, real-time safe.
class Assembler {
 public:
  Assembler(const AssemblyConfig& config, const hdl64::Calibration& calibration, SweepExchange& exchange);
  ~Assembler();

  /// What kind of firings come from now on: single return and 48 us apart unless said otherwise. No sweep may
  /// be open.
  void set_format(const hdl64::StreamFormat& format) noexcept;

  /// Takes the next firing, in order of time. `others`, dual return only, are what its lasers saw besides.
  void add(const Firing& firing,
           const hdl64::FiringReturns& strongest,
           const hdl64::FiringReturns* others = nullptr) noexcept;

  /// No firing comes any more before the cut: the sensor does not look there. Ends the open sweep, as the
  /// next firing beyond the cut would.
  void end_rotation() noexcept;

  /// The stream broke off and will go on elsewhere (clock restarted, head stopped or jumped): ends the open
  /// sweep. Without effect when nothing was added since the last call.
  void interrupt() noexcept;

  /// The stream is over, or has fallen silent: ends the open sweep. What comes later begins a new stream.
  void finish() noexcept;

  /// For the headers of sweeps that are handed on from now on (SweepHeader::clock_offset_ns).
  void set_clock_offset(std::int64_t offset_ns) noexcept { clock_offset_ns_ = offset_ns; }

  /// A malformed datagram came; noted in the open sweep's header.
  void note_bad_packet() noexcept {
    if (open_ != nullptr) ++open_->header.packets_bad;
  }

  const AssemblyCounters& counters() const noexcept { return counters_; }

 private:
  /// Where the previous firing was.
  struct Last {
    bool is_valid = false;  ///< false at the start and after an interruption
    int column = 0;         ///< of a laser without rotCorrection; kMaxColumns: beyond
    std::int64_t time_ns = 0;
    double turn = 0.0, step = 0.0;  ///< rotations since the cut azimuth; and from firing to firing
  };
  struct Lanes;  // per laser, and the newest columns

  bool is_dual() const noexcept { return room_ > hdl64::kLasers; }
  std::int64_t steps_after_last(std::int64_t time_ns) const noexcept;
  int cross_cut(const Firing& firing, double turn, double step, std::int64_t rotation) noexcept;
  void open(const Firing& firing, int column, int columns, bool after_gap) noexcept;
  void aim_lasers(double step) noexcept;
  void append(const Firing& firing,
              int column,
              const hdl64::FiringReturns& strongest,
              const hdl64::FiringReturns* others) noexcept;
  void fill_cells(std::uint64_t valid, int column) noexcept;
  void write_cells() noexcept;
  void leave_empty(int column) noexcept;
  void leave_rest_empty() noexcept;
  void hand_on_sectors() noexcept;
  void close_at_cut(int lost_before_cut, bool is_blind) noexcept;
  void close_within_rotation(std::uint32_t flags) noexcept;
  void complete_header(double end_turn, int due_until, int columns, std::uint32_t flags) noexcept;
  void fold_margins() noexcept;
  void hand_on() noexcept;

  SweepExchange& exchange_;
  double cut_rev_;
  std::int64_t firing_period_ns_ = hdl64::kFiringPeriod_ns;
  std::uint32_t room_ = hdl64::kLasers;  // that a firing's returns may need
  bool had_echoes_ = false;              // sweeps of single return may hold some of an earlier use
  int sectors_;
  std::unique_ptr<Lanes> lanes_;

  std::int64_t rotation_ = 0;  // the present one, by the encoder
  std::uint64_t sequence_ = 0;
  bool is_first_ = true;       // no rotation was begun yet
  bool begins_stream_ = true;  // the next sweep is the first of its stream
  Last last_;

  // The open sweep.
  Sweep* open_ = nullptr;
  Sweep* spare_ = nullptr;  // acquired at a cut, for the rotation that begins there
  double start_turn_ = 0.0;
  bool is_first_of_stream_ = false;
  int expected_from_ = 0, filled_until_ = 0;  // columns in which firings were due, and were had
  int lowest_shift_ = 0;
  int blind_ = 0;  // firings of it that were never sent
  int sector_columns_ = 0, next_sector_column_ = 0;
  int parts_handed_on_ = 0;

  std::int64_t clock_offset_ns_ = 0;
  AssemblyCounters counters_;
};

}  // namespace pago
