// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/assembler.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>
#include <numbers>
#include <utility>

namespace pago {

namespace {

/// A sweep with less of its rotation than this is partial or incomplete.
constexpr double kWhole = 0.9;
/// Returns are copied 64 at a time, valid or not.
constexpr std::uint32_t kRoom = hdl64::kLasers;

/// FiringDecoder::laser_time_ns() as arithmetic that becomes vector code.
constexpr std::int32_t laser_time_ns(std::int32_t laser) noexcept {
  const std::int32_t slot = laser % hdl64::kLasersPerBlock, in_group = slot % 4;
  return 6000 * (slot / 4) + 1200 * in_group + (in_group == 0 ? 0 : 60);
}
static_assert([] {
  for (int laser = 0; laser < hdl64::kLasers; ++laser)
    if (laser_time_ns(laser) != hdl64::FiringDecoder::laser_time_ns(laser)) return false;
  return true;
}());

/// Asks for the cache lines that the returns of one firing will fill.
template <typename T>
void fetch_room(const T* at) noexcept {
  constexpr std::size_t kPerLine = kCacheLineBytes / sizeof(T);
  for (std::size_t i = 0; i < kRoom; i += kPerLine) __builtin_prefetch(at + i, 1);
}

int columns_of_rotation(double step) noexcept {
  return static_cast<int>(std::clamp(std::round(1.0 / step), 1.0, static_cast<double>(kMaxColumns)));
}

}  // namespace

Assembler::Assembler(const AssemblyConfig& config,
                     const hdl64::Calibration& calibration,
                     SweepExchange& exchange,
                     std::int64_t firing_period_ns)
    : exchange_(exchange),
      cut_rev_(config.cut_azimuth_deg / 360.0),
      firing_period_ns_(firing_period_ns),
      sectors_(config.sectors) {
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    laser_rotation_rev_[laser] = calibration.lasers[laser].rotation_rad / (2.0 * std::numbers::pi);
    laser_ring_[laser] = calibration.ring_of_laser[laser];
  }
}

void Assembler::add(const Firing& firing, const hdl64::FiringReturns& returns) noexcept {
  const double step = firing.rate_rev_s * static_cast<double>(firing_period_ns_) * 1e-9;
  const double turn = firing.revolutions - cut_rev_;
  // The firing nearest to the cut is the first of its rotation.
  const auto rotation = static_cast<std::int64_t>(std::floor(turn + 0.5 * step));
  int column = 0;
  if (!last_.is_valid || rotation > rotation_) {
    column = cross_cut(firing, turn, step, rotation);
  } else {
    column = static_cast<int>(
        std::min<std::int64_t>(last_.column + steps_after_last(firing.time_ns), kMaxColumns));
    if (open_ != nullptr && (column == kMaxColumns || open_->size + kRoom > open_->capacity()))
      close_within_rotation(kOverfull);
  }
  last_ = {true, column, firing.time_ns, turn, step};
  if (open_ == nullptr) return;
  append(returns, column, static_cast<std::int32_t>(firing.time_ns - open_->header.start_ns));
  open_->header.last_arrival_ns = firing.arrival_ns;
  if (sectors_ > 1) hand_on_sectors();
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
    close_at_cut(static_cast<int>(std::min<std::int64_t>(lost_before_cut, kMaxColumns)));
  }
  const bool after_gap = goes_on ? rotation > rotation_ + 1 : !is_first_;
  if (!is_first_) sequence_ += static_cast<std::uint64_t>(std::max<std::int64_t>(1, rotation - rotation_));
  rotation_ = rotation;
  expected_from_ = column - static_cast<int>(lost_after_cut);
  start_turn_ = goes_on ? static_cast<double>(rotation) : std::max(turn, static_cast<double>(rotation));
  aim_lasers(step);
  open(firing, columns_of_rotation(step), after_gap);
  return column;
}

void Assembler::open(const Firing& firing, int columns, bool after_gap) noexcept {
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
}

void Assembler::aim_lasers(double step) noexcept {
  lowest_shift_ = 0;
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    const double columns = std::round(-laser_rotation_rev_[laser] / step);
    shift_[laser] = static_cast<std::int32_t>(std::clamp(columns, -1.0 * kColumnMargin, 1.0 * kColumnMargin));
    cell_[laser] = laser_ring_[laser] * RangeImage::kRowStride + shift_[laser];
    lowest_shift_ = std::min(lowest_shift_, shift_[laser]);
  }
}

void Assembler::append(const hdl64::FiringReturns& returns, int column, std::int32_t offset_ns) noexcept {
  Sweep& sweep = *open_;
  const std::uint32_t at = sweep.size;
  const auto size = static_cast<std::uint32_t>(returns.size);
  std::memcpy(sweep.x_m.data() + at, returns.x_m.data(), sizeof returns.x_m);
  std::memcpy(sweep.y_m.data() + at, returns.y_m.data(), sizeof returns.y_m);
  std::memcpy(sweep.z_m.data() + at, returns.z_m.data(), sizeof returns.z_m);
  std::memcpy(sweep.intensity.data() + at, returns.intensity.data(), sizeof returns.intensity);
  std::memcpy(sweep.ring.data() + at, returns.ring.data(), sizeof returns.ring);
  std::int32_t* const times_ns = sweep.time_offset_ns.data() + at;
  for (std::size_t i = 0; i < hdl64::kLasers; ++i) times_ns[i] = offset_ns + laser_time_ns(returns.laser[i]);
  std::int32_t* const cells = sweep.range_image.row(0) + column;
  std::uint16_t* const columns = sweep.column.data() + at;
  for (std::uint32_t i = 0; i < size; ++i) {
    const std::size_t laser = returns.laser[i];
    cells[cell_[laser]] = static_cast<std::int32_t>(at + i);
    // Below zero until fold_margins() adds the number of columns: modulo 2^16 that comes out right.
    columns[i] = static_cast<std::uint16_t>(column + shift_[laser]);
  }
  fetch_rows_ahead(cells, column);
  fetch_arrays_ahead();
  sweep.size = at + size;
  filled_until_ = column + 1;
  ++sweep.header.firings_received;
  sweep.header.end_ns = sweep.header.start_ns + offset_ns + firing_period_ns_;
}

// Sixteen columns of a ring share a cache line, and 64 lines are more streams than a processor foresees. Each
// firing asks for the next line of four rings, and for where the firings after next will go (measured: 15 %
// more packets per second).
void Assembler::fetch_rows_ahead(const std::int32_t* cells, int column) const noexcept {
  constexpr std::size_t kColumnsPerLine = kCacheLineBytes / sizeof(std::int32_t);
  constexpr std::size_t kRings = hdl64::kLasers / kColumnsPerLine;
  const std::size_t first = static_cast<std::size_t>(column) % kColumnsPerLine * kRings;
  for (std::size_t i = 0; i < kRings; ++i) __builtin_prefetch(cells + cell_[first + i] + kColumnsPerLine, 1);
}

void Assembler::fetch_arrays_ahead() noexcept {
  constexpr std::uint32_t kAhead = 4 * hdl64::kLasers;
  const std::size_t at = std::min(open_->size + kAhead, open_->capacity() - kRoom);
  fetch_room(open_->x_m.data() + at);
  fetch_room(open_->y_m.data() + at);
  fetch_room(open_->z_m.data() + at);
  fetch_room(open_->intensity.data() + at);
  fetch_room(open_->ring.data() + at);
  fetch_room(open_->column.data() + at);
  fetch_room(open_->time_offset_ns.data() + at);
}

void Assembler::hand_on_sectors() noexcept {
  const int closed_until = filled_until_ + lowest_shift_;
  // Never more parts than sectors, however much the head slows down: queues are sized by that.
  if (closed_until < next_sector_column_ || parts_handed_on_ == sectors_ - 1) return;
  while (next_sector_column_ <= closed_until) next_sector_column_ += sector_columns_;
  ++parts_handed_on_;
  exchange_.hand_on({open_, open_->size, static_cast<std::uint32_t>(closed_until), false});
}

void Assembler::close_at_cut(int lost_before_cut) noexcept {
  if (open_ == nullptr) return;
  const int columns = std::min(filled_until_ + lost_before_cut, kMaxColumns);
  complete_header(static_cast<double>(rotation_ + 1), columns, columns, 0);
  spare_ = exchange_.acquire();
  if (spare_ != nullptr || parts_handed_on_ > 0) return hand_on();
  ++counters_.no_free_sweep;
  counters_.is_open = 0;
  spare_ = open_;
  // It is still the one that was asked for then.
  const std::uint64_t request = spare_->header.request;
  const StageTime asked = spare_->time_of(StageId::kIngest);
  spare_->reset();
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
  header.firings_lost = static_cast<std::uint32_t>(due_until - expected_from_) - header.firings_received;
  header.rotation_rev = static_cast<float>(end_turn - start_turn_);
  const bool is_whole = end_turn - start_turn_ >= kWhole;
  const bool began_late = is_first_of_stream_ && start_turn_ > static_cast<double>(rotation_ + 1) - kWhole;
  if (is_whole) flags &= ~std::uint32_t{kPartialEnd};
  header.flags |= flags | (began_late ? kPartialStart : 0U);
  const bool is_thin = !is_whole || header.firings_received < kWhole * columns;
  if (is_thin && header.is_posed()) header.flags |= kIncomplete;
}

// A laser's columns are its firings' plus a constant, so wrapping by the number of columns maps them one to
// one onto [0, columns): every target is empty.
void Assembler::fold_margins() noexcept {
  Sweep& sweep = *open_;
  const int columns = static_cast<int>(sweep.header.num_columns);
  for (std::size_t laser = 0; laser < hdl64::kLasers; ++laser) {
    std::int32_t* const row = sweep.range_image.row(laser_ring_[laser]);
    const int shift = shift_[laser];
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
