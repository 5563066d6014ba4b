// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/status_reader.hpp"

#include <algorithm>
#include <cmath>

#include "laser_limits.hpp"

namespace pago::hdl64 {

namespace {

constexpr std::size_t kFirstSlot = 9;  // of a cycle's seven bytes, behind H M S D N Y G T V
constexpr std::size_t kLaserBytes = 21, kLaserCycles = 4;
constexpr std::size_t kParameterByte = 7 * 256;  // behind the lasers: the calibration's date
constexpr std::uint16_t kLengthWord = 1820;
/// More packets than this cannot be counted by the clock: their period is known to 2e-5 only.
constexpr std::int64_t kMostPacketsOn = 20'000;
/// Contradictions weigh four packets that fit: damaged bytes are rarer, a wrong place shows in most packets.
constexpr int kContradiction = 4, kLost = 16;

constexpr auto kCrcTable = [] {
  std::array<std::uint16_t, 256> table{};
  for (std::uint32_t byte = 0; byte < table.size(); ++byte) {
    std::uint32_t crc = byte << 8U;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 0x8000U) != 0 ? crc << 1U ^ 0x8005U : crc << 1U;
    table[byte] = static_cast<std::uint16_t>(crc);
  }
  return table;
}();

/// CRC-16 with polynomial 0x8005, from 0, not reflected (CRC-16/BUYPASS).
void add_to_crc(std::uint16_t& crc, std::uint8_t byte) noexcept {
  crc = static_cast<std::uint16_t>(crc << 8U ^ kCrcTable[(crc >> 8U ^ byte) & 0xFFU]);
}

std::size_t in_round(std::size_t index) noexcept {
  return index % StatusReader::kRoundPackets;
}

constexpr std::uint8_t kAnySlot = 0xFF;
/// Each type has one place in its cycle of 16.
constexpr auto kSlotOfType = [] {
  std::array<std::uint8_t, 256> slots{};
  slots.fill(kAnySlot);
  constexpr std::array<std::uint8_t, 16> kPlain{'H', 'M', 'S', 'D', 'N', 'Y', 'G', 'T',
                                                'V', '1', '2', '3', '4', '5', '6', '7'};
  for (std::uint8_t slot = 0; slot < kPlain.size(); ++slot) slots[kPlain[slot]] = slot;
  struct Special {
    std::uint8_t type, slot;
  };
  for (const Special special : {Special{'W', 9}, Special{0xFE, 9}, Special{0xFF, 10}, Special{0xFC, 11},
                                Special{0xF9, 11}, Special{0xFD, 12}, Special{0xFA, 13}, Special{0xF8, 13},
                                Special{0xF7, 14}, Special{0xFB, 14}, Special{0xF6, 15}})
    slots[special.type] = special.slot;
  return slots;
}();

GpsState gps_state(std::uint8_t value) noexcept {
  switch (value) {
    case 'A':
      return GpsState::kFixed;
    case 'P':
      return GpsState::kPulse;
    case 'V':
      return GpsState::kTime;
    default:
      return GpsState::kNone;
  }
}

ReturnMode return_mode(std::uint8_t value) noexcept {
  constexpr std::array kModes{ReturnMode::kStrongest, ReturnMode::kLast, ReturnMode::kBoth};
  return value < kModes.size() ? kModes[value] : ReturnMode::kUnknown;
}

}  // namespace

void StatusReader::add(std::uint8_t type, std::uint8_t value, std::int64_t packets_on) noexcept {
  read_at_once(type, value);
  if (packets_on > kMostPacketsOn) lose_place();
  std::size_t index = in_round(index_ + static_cast<std::size_t>(std::max<std::int64_t>(0, packets_on)));
  // Where a sensor is silent on purpose (outside its field of view) nothing is missing between.
  const std::size_t next = in_round(index_ + 1);
  if (contradicts(index, type) && !contradicts(next, type)) index = next;
  contradictions_ = std::max(0, contradictions_ + (contradicts(index, type) ? kContradiction : -1));
  if (contradictions_ >= kLost) lose_place();
  if (!is_placed_) {
    // Begins with its place in the cycle, so that all other types are known to fit or not.
    if (kSlotOfType[type] == kAnySlot) return;
    index = kSlotOfType[type];
    is_placed_ = true;
  }
  index_ = index;
  vote(index, type, value);
  if (value == '#') look_for_start();
  const bool is_end_of_cycle = index % kCyclePackets == kCyclePackets - 1;
  if (is_end_of_cycle && start_ && is_news_ && num_filled_ == kRoundPackets) conclude();
}

void StatusReader::lose_place() noexcept {
  places_ = {};
  num_filled_ = 0;
  num_with_votes_ = {};
  start_.reset();
  contradictions_ = 0;
  is_placed_ = false;
  is_news_ = false;
}

bool StatusReader::contradicts(std::size_t index, std::uint8_t type) const noexcept {
  if (!is_placed_) return false;
  const std::uint8_t slot = kSlotOfType[type];
  return (slot != kAnySlot && slot != index % kCyclePackets) ||
         (places_[index].votes > 0 && places_[index].type != type);
}

void StatusReader::vote(std::size_t index, std::uint8_t type, std::uint8_t value) noexcept {
  Place& place = places_[index];
  const bool is_of_round = index % kCyclePackets >= kFirstSlot;  // the rest is the cycle's own: time, GPS
  if (place.votes == 0) {
    ++num_filled_;
    num_with_votes_[0] += is_of_round ? 1U : 0U;
    place = {type, value, 1};
  } else if (place.value == value && place.type == type) {
    if (place.votes == kMostVotes) return;
    num_with_votes_[place.votes++] += is_of_round ? 1U : 0U;
    if (has_calibration()) return;
  } else if (place.votes > 1) {
    num_with_votes_[--place.votes] -= is_of_round ? 1U : 0U;
    return;
  } else {
    place = {type, value, 1};
  }
  is_news_ = true;
}

// Types that occur in one meaning only.
void StatusReader::read_at_once(std::uint8_t type, std::uint8_t value) noexcept {
  switch (type) {
    case 'H':
      status_.time[0] = value;
      break;
    case 'M':
      status_.time[1] = value;
      break;
    case 'S':
      status_.time[2] = value;
      break;
    case 'D':
      status_.date[0] = value;
      break;
    case 'N':
      status_.date[1] = value;
      break;
    case 'Y':
      status_.date[2] = value;
      break;
    case 'G':
      status_.gps = gps_state(value);
      break;
    case 'T':
      status_.temperature_c = value;
      break;
    case 'V':
      status_.firmware = value;
      break;
    case 'W':
      status_.warnings = value;
      break;
    case 0xF8:
      status_.power_level = value;
      break;
    case 0xF9:
      status_.return_mode = return_mode(value);
      break;
    default:
      break;
  }
}

void StatusReader::look_for_start() noexcept {
  constexpr std::array<std::uint8_t, 5> kMarker{'U', 'N', 'I', 'T', '#'};
  for (std::size_t i = 0; i < kMarker.size(); ++i) {
    const Place& at = places_[in_round(index_ + kRoundPackets - (kMarker.size() - 1) + i)];
    if (at.votes == 0 || at.value != kMarker[i]) return;
  }
  const std::size_t start = in_round(index_ + kRoundPackets - (kFirstSlot + kMarker.size() - 1));
  if (start_ && *start_ != start) return lose_place();  // one of the two is wrong
  start_ = start;
}

// All places are filled.
void StatusReader::conclude() noexcept {
  is_news_ = false;
  read_parameters();
  const Checksum checksum = check();
  if (checksum == Checksum::kNone || !read_lasers()) return;
  checksum_ = checksum;
  ++readings_;
  if (checksum == Checksum::kLength) status_.warnings = place(kParameterByte + 24).value;
}

Checksum StatusReader::check() const noexcept {
  const auto all_have_votes = [this](std::size_t votes) { return num_with_votes_[votes - 1] == kBytes; };
  const std::uint16_t sent = word(kBytes - 2);
  if (sent == kLengthWord) return all_have_votes(2) ? Checksum::kLength : Checksum::kNone;
  if (crc_of_lasers() == sent) return Checksum::kCrc;
  return all_have_votes(kMostVotes) ? Checksum::kAgreed : Checksum::kNone;
}

/// Their numbers are not part of it.
std::uint16_t StatusReader::crc_of_lasers() const noexcept {
  std::uint16_t crc = 0;
  for (std::size_t laser = 0; laser < 64; ++laser)
    for (std::size_t i = 1; i < kLaserBytes; ++i)
      add_to_crc(crc, place(kCycleBytes * (1 + kLaserCycles * laser) + i).value);
  return crc;
}

const StatusReader::Place& StatusReader::place(std::size_t byte) const noexcept {
  const std::size_t cycle = byte / kCycleBytes, slot = kFirstSlot + byte % kCycleBytes;
  return places_[in_round(*start_ + cycle * kCyclePackets + slot)];
}

std::uint16_t StatusReader::word(std::size_t byte) const noexcept {
  return static_cast<std::uint16_t>(place(byte).value | place(byte + 1).value << 8U);
}

bool StatusReader::read_lasers() noexcept {
  std::array<LaserCalibration, 64> lasers{};
  for (std::size_t i = 0; i < lasers.size(); ++i) {
    const std::size_t at = 7 * (1 + kLaserCycles * i);
    const auto figure = [&](std::size_t byte) { return static_cast<double>(std::int16_t(word(at + byte))); };
    LaserCalibration& laser = lasers[i];
    laser.vertical_rad = figure(1) * 0.01 * kDegree;
    laser.rotation_rad = figure(3) * 0.01 * kDegree;
    laser.distance_m = figure(5) * 1e-3;
    laser.distance_x_m = figure(7) * 1e-3;
    laser.distance_y_m = figure(9) * 1e-3;
    laser.vertical_offset_m = figure(11) * 1e-3;
    laser.horizontal_offset_m = figure(13) * 1e-3;
    laser.focal_distance_m = figure(15) * 1e-3;
    laser.focal_slope = figure(17) * 0.1;
    laser.min_intensity = place(at + 19).value;
    laser.max_intensity = place(at + 20).value;
    fill_near_point(laser);
    if (place(at).value != i || !is_plausible(laser)) return false;
  }
  lasers_ = lasers;
  return true;
}

void StatusReader::read_parameters() noexcept {
  const auto byte = [this](std::size_t at) { return place(at).value; };
  const auto address = [&](std::size_t at) {
    return std::uint32_t{byte(at)} << 24U | std::uint32_t{byte(at + 1)} << 16U |
           std::uint32_t{byte(at + 2)} << 8U | byte(at + 3);
  };
  constexpr std::size_t p = kParameterByte;
  status_.upper_threshold = byte(5);
  status_.lower_threshold = byte(6);
  for (std::size_t i = 0; i < status_.calibrated.size(); ++i) status_.calibrated[i] = byte(p + i);
  status_.humidity_percent = byte(p + 6);
  status_.motor_rpm = word(p + 7);
  status_.view_start_cdeg = word(p + 9);
  status_.view_end_cdeg = word(p + 11);
  status_.life_hours = word(p + 13);
  status_.source_ipv4 = address(p + 15);
  status_.destination_ipv4 = address(p + 19);
}

double StatusReader::progress() const noexcept {
  if (has_calibration()) return 1.0;
  return std::min(0.99, static_cast<double>(num_filled_) / static_cast<double>(kRoundPackets));
}

std::optional<Calibration> StatusReader::calibration(VerticalOffset vertical_offset) const {
  if (!has_calibration()) return std::nullopt;
  Calibration result;
  result.lasers = lasers_;
  result.ring_of_laser = rank_rings(lasers_);
  result.two_point = std::any_of(lasers_.begin(), lasers_.end(), [](const LaserCalibration& laser) {
    return laser.distance_x_m != laser.distance_m || laser.distance_y_m != laser.distance_m;
  });
  result.vertical_offset = vertical_offset;
  result.power_level = power_level_of(status_);
  result.origin = "the sensor's own, from its status bytes";
  return result;
}

}  // namespace pago::hdl64
