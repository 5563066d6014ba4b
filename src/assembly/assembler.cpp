// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "firing_lanes.hpp"
#include "image_tile.hpp"

namespace pago {

namespace {

/// A sweep with less of its rotation than this is partial or incomplete.
constexpr double kWhole = 0.9;

int columns_of_rotation(double step) noexcept {
  return static_cast<int>(std::clamp(std::round(1.0 / step), 1.0, static_cast<double>(kMaxColumns)));
}

}  // namespace

struct Assembler::Lanes {
  std::array<double, hdl64::kLasers> rotation_rev{};
  std::array<std::int32_t, hdl64::kLasers> shift{};  // of a laser's column against the firing's
  std::array<std::int32_t, hdl64::kLasers> cell{};   // where a laser's column 0 lies in the range image
  LaserLanes lasers;
  ImageTile tile;
};

Assembler::Assembler(const AssemblyConfig& config,
                     const hdl64::Calibration& calibration,
                     SweepExchange& exchange)
    : exchange_(exchange),
      cut_rev_(config.cut_azimuth_deg / 360.0),
      sectors_(config.sectors),
      lanes_(std::make_unique<Lanes>()) {
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    lanes_->rotation_rev[laser] = calibration.lasers[laser].rotation_rad / (2.0 * std::numbers::pi);
    lanes_->lasers.ring[laser] = calibration.ring_of_laser[laser];
  }
  set_format({});
}

Assembler::~Assembler() = default;

void Assembler::set_format(const hdl64::StreamFormat& format) noexcept {
  assert(open_ == nullptr);
  firing_period_ns_ = format.firing_period_ns;
  room_ = format.is_dual() ? 2 * hdl64::kLasers : hdl64::kLasers;
  had_echoes_ = had_echoes_ || is_dual();
  lanes_->lasers.time_ns = hdl64::laser_times_ns(format);
}

void Assembler::add(const Firing& firing,
                    const hdl64::FiringReturns& strongest,
                    const hdl64::FiringReturns* others) noexcept {
  const double step = firing.rate_rev_s * static_cast<double>(firing_period_ns_) * 1e-9;
  const double turn = firing.revolutions - cut_rev_;
  // The firing nearest to the cut is the first of its rotation.
  const auto rotation = static_cast<std::int64_t>(std::floor(turn + 0.5 * step));
  int column = 0;
  if (!last_.is_valid || rotation > rotation_) {
    column = cross_cut(firing, turn, step, rotation);
  } else {
    const std::int64_t steps = steps_after_last(firing.time_ns);
    column = static_cast<int>(std::min<std::int64_t>(last_.column + steps, kMaxColumns));
    if (firing.is_after_blind) blind_ += column - last_.column - 1;
    if (open_ != nullptr && (column == kMaxColumns || open_->size + room_ > open_->capacity()))
      close_within_rotation(kOverfull);
  }
  last_ = {true, column, firing.time_ns, turn, step};
  if (open_ == nullptr) return;
  append(firing, column, strongest, others);
  if (sectors_ > 1) hand_on_sectors();
}

void Assembler::end_rotation() noexcept {
  if (open_ == nullptr) return;
  const double to_cut = (static_cast<double>(rotation_ + 1) - last_.turn) / last_.step;
  const int columns = std::min(
      std::max(filled_until_, static_cast<int>(filled_until_ + std::lround(to_cut) - 1)), kMaxColumns);
  blind_ += columns - filled_until_;
  complete_header(static_cast<double>(rotation_ + 1), columns, columns, 0);
  hand_on();
}

void Assembler::interrupt() noexcept {
  if (open_ != nullptr) close_within_rotation(0);
  last_.is_valid = false;
}

void Assembler::finish() noexcept {
  if (open_ != nullptr) close_within_rotation(kPartialEnd);
  last_.is_valid = false;
  begins_stream_ = true;
}

std::int64_t Assembler::steps_after_last(std::int64_t time_ns) const noexcept {
  const std::int64_t passed_ns = time_ns - last_.time_ns + firing_period_ns_ / 2;
  if (passed_ns < 2 * firing_period_ns_) return 1;  // the rule, and spares the division
  return passed_ns / firing_period_ns_;
}

int Assembler::cross_cut(const Firing& firing, double turn, double step, std::int64_t rotation) noexcept {
  const bool goes_on = last_.is_valid;
  // A stream that starts on the last firing before the cut starts a whole sweep.
  if (!goes_on && static_cast<double>(rotation + 1) - turn <= step) ++rotation;
  const double past_cut = std::round((turn - static_cast<double>(rotation)) / step);
  const int column = static_cast<int>(std::clamp(past_cut, 0.0, kMaxColumns - 1.0));

  const std::int64_t lost = goes_on ? steps_after_last(firing.time_ns) - 1 : 0;
  const std::int64_t lost_after_cut = std::min<std::int64_t>(column, lost);
  if (goes_on) {
    std::int64_t lost_before_cut = lost - lost_after_cut;
    if (rotation > rotation_ + 1) {  // the rest were due in rotations of which nothing came
      const double to_cut = (static_cast<double>(rotation_ + 1) - last_.turn) / last_.step;
      lost_before_cut = std::clamp<std::int64_t>(std::llround(to_cut) - 1, 0, lost_before_cut);
    }
    close_at_cut(static_cast<int>(std::min<std::int64_t>(lost_before_cut, kMaxColumns)),
                 firing.is_after_blind);
  }
  const bool after_gap = goes_on ? rotation > rotation_ + 1 : !is_first_;
  if (!is_first_) sequence_ += static_cast<std::uint64_t>(std::max<std::int64_t>(1, rotation - rotation_));
  rotation_ = rotation;
  expected_from_ = column - static_cast<int>(lost_after_cut);
  blind_ = firing.is_after_blind ? static_cast<int>(lost_after_cut) : 0;
  start_turn_ = goes_on ? static_cast<double>(rotation) : std::max(turn, static_cast<double>(rotation));
  aim_lasers(step);
  open(firing, column, columns_of_rotation(step), after_gap);
  return column;
}

void Assembler::open(const Firing& firing, int column, int columns, bool after_gap) noexcept {
  ++counters_.opened;
  is_first_of_stream_ = begins_stream_;
  is_first_ = begins_stream_ = false;
  open_ = spare_ != nullptr ? spare_ : exchange_.acquire();
  spare_ = nullptr;
  if (open_ == nullptr) {
    ++counters_.no_free_sweep;
    return;
  }
  counters_.is_open = 1;
  filled_until_ = expected_from_;
  parts_handed_on_ = 0;
  sector_columns_ = next_sector_column_ = (columns + sectors_ - 1) / sectors_;
  SweepHeader& header = open_->header;
  header.sequence = sequence_;
  header.start_ns = firing.time_ns;
  header.first_arrival_ns = firing.arrival_ns;
  if (after_gap) header.flags |= kAfterGap;
  if (had_echoes_ && !is_dual()) std::fill(open_->echo.begin(), open_->echo.end(), std::uint8_t{0});
  lanes_->tile.start(column);
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser)
    open_->range_image.clear(lanes_->lasers.ring[laser], -kColumnMargin, column + lanes_->shift[laser]);
}

void Assembler::aim_lasers(double step) noexcept {
  Lanes& l = *lanes_;
  lowest_shift_ = 0;
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    const double columns = std::round(-l.rotation_rev[laser] / step);
    const auto shift =
        static_cast<std::int32_t>(std::clamp(columns, -1.0 * kColumnMargin, 1.0 * kColumnMargin));
    l.shift[laser] = shift;
    l.lasers.shift[laser] = static_cast<std::uint16_t>(shift);
    l.cell[laser] = l.lasers.ring[laser] * RangeImage::kRowStride + shift;
    lowest_shift_ = std::min(lowest_shift_, shift);
  }
}

void Assembler::append(const Firing& firing,
                       int column,
                       const hdl64::FiringReturns& strongest,
                       const hdl64::FiringReturns* others) noexcept {
  Sweep& sweep = *open_;
  const FiringPlace place{column, static_cast<std::int32_t>(firing.time_ns - sweep.header.start_ns)};
  ReturnSlots::at(sweep, sweep.size).prefetch();
  fill_cells(strongest.valid, column);
  const auto write = [&](const hdl64::FiringReturns& returns) {
    const ReturnSlots to = ReturnSlots::at(sweep, sweep.size);
    fastest::append(returns, lanes_->lasers, place, to);
    if (others != nullptr) fastest::append_echoes(returns, to.echo);
    sweep.size += static_cast<std::uint32_t>(std::popcount(returns.valid));
  };
  write(strongest);
  if (others != nullptr) write(*others);
  filled_until_ = column + 1;
  SweepHeader& header = sweep.header;
  ++header.firings_received;
  header.end_ns = firing.time_ns + firing_period_ns_;
  header.last_arrival_ns = firing.arrival_ns;
}

void Assembler::fill_cells(std::uint64_t valid, int column) noexcept {
  ImageTile& tile = lanes_->tile;
  if (!tile.takes(column)) {
    write_cells();
    leave_empty(column);
  }
  tile.prefetch(open_->range_image.row(0), lanes_->cell);
  fastest::number(valid, open_->size, tile.next());
}

/// After this the range image is up to date, as far as firings have come.
void Assembler::write_cells() noexcept {
  lanes_->tile.write(open_->range_image.row(0), lanes_->cell);
}

/// No firing comes before this column.
void Assembler::leave_empty(int column) noexcept {
  const Lanes& l = *lanes_;
  const int begin = l.tile.end();
  if (begin < column)
    for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser)
      open_->range_image.clear(l.lasers.ring[laser], begin + l.shift[laser], column + l.shift[laser]);
  lanes_->tile.start(column);
}

/// Nor any more in this sweep.
void Assembler::leave_rest_empty() noexcept {
  const Lanes& l = *lanes_;
  const int columns = std::max(static_cast<int>(open_->header.num_columns), open_->stale_columns);
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser)
    open_->range_image.clear(l.lasers.ring[laser], l.tile.end() + l.shift[laser], columns + kColumnMargin);
  open_->stale_columns = 0;
}

void Assembler::hand_on_sectors() noexcept {
  const int closed_until = filled_until_ + lowest_shift_;
  // Never more parts than sectors, however much the head slows down: queues are sized by that.
  if (closed_until < next_sector_column_ || parts_handed_on_ == sectors_ - 1) return;
  while (next_sector_column_ <= closed_until) next_sector_column_ += sector_columns_;
  ++parts_handed_on_;
  write_cells();
  exchange_.hand_on({open_, open_->size, static_cast<std::uint32_t>(closed_until), false});
}

void Assembler::close_at_cut(int lost_before_cut, bool is_blind) noexcept {
  if (open_ == nullptr) return;
  const int columns = std::min(filled_until_ + lost_before_cut, kMaxColumns);
  if (is_blind) blind_ += columns - filled_until_;
  complete_header(static_cast<double>(rotation_ + 1), columns, columns, 0);
  spare_ = exchange_.acquire();
  if (spare_ != nullptr || parts_handed_on_ > 0) return hand_on();
  ++counters_.no_free_sweep;
  counters_.is_open = 0;
  lanes_->tile.start(0);
  spare_ = open_;
  // It is still the one that was asked for then.
  const std::uint64_t request = spare_->header.request;
  const StageTime asked = spare_->time_of(StageId::kIngest);
  spare_->recycle();
  spare_->header.request = request;
  spare_->time_of(StageId::kIngest) = asked;
}

void Assembler::close_within_rotation(std::uint32_t flags) noexcept {
  const int columns = std::max(filled_until_, columns_of_rotation(last_.step));
  complete_header(last_.turn + last_.step, filled_until_, columns, flags);
  hand_on();
}

void Assembler::complete_header(double end_turn, int due_until, int columns, std::uint32_t flags) noexcept {
  SweepHeader& header = open_->header;
  header.num_columns = static_cast<std::uint32_t>(columns);
  header.clock_offset_ns = clock_offset_ns_;
  header.firings_blind = static_cast<std::uint32_t>(blind_);
  header.firings_lost =
      static_cast<std::uint32_t>(due_until - expected_from_ - blind_) - header.firings_received;
  header.rotation_rev = static_cast<float>(end_turn - start_turn_);
  const bool is_whole = end_turn - start_turn_ >= kWhole;
  const bool began_late = is_first_of_stream_ && start_turn_ > static_cast<double>(rotation_ + 1) - kWhole;
  if (is_whole) flags &= ~std::uint32_t{kPartialEnd};
  header.flags |= flags | (began_late ? kPartialStart : 0U);
  const bool is_thin = !is_whole || header.firings_received < kWhole * (columns - blind_);
  if (is_thin && header.is_posed()) header.flags |= kIncomplete;
}

// A laser's columns are its firings' plus a constant, so wrapping by the number of columns maps them one to
// one onto [0, columns): every target is empty.
void Assembler::fold_margins() noexcept {
  Sweep& sweep = *open_;
  const int columns = static_cast<int>(sweep.header.num_columns);
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    std::int32_t* const row = sweep.range_image.row(lanes_->lasers.ring[laser]);
    const int shift = lanes_->shift[laser];
    const int begin = shift < 0 ? shift : columns, end = shift < 0 ? 0 : columns + shift;
    const int wrap = shift < 0 ? columns : -columns;
    for (int column = begin; column < end; ++column) {
      const std::int32_t index = std::exchange(row[column], RangeImage::kEmpty);
      if (index == RangeImage::kEmpty) continue;
      assert(row[column + wrap] == RangeImage::kEmpty);
      row[column + wrap] = index;
      sweep.column[static_cast<std::size_t>(index)] = static_cast<std::uint16_t>(column + wrap);
    }
  }
}

void Assembler::hand_on() noexcept {
  write_cells();
  leave_rest_empty();
  fold_margins();
  const SweepHeader& header = open_->header;
  ++counters_.handed_on;
  counters_.partial += header.has(kPartialStart) || header.has(kPartialEnd) ? 1U : 0U;
  counters_.incomplete += header.has(kIncomplete) ? 1U : 0U;
  counters_.overfull += header.has(kOverfull) ? 1U : 0U;
  counters_.is_open = 0;
  exchange_.hand_on({open_, open_->size, header.num_columns, true});
  open_ = nullptr;
}

}  // namespace pago
