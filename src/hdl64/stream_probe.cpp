// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/hdl64/stream_probe.hpp"

#include <algorithm>
#include <cstring>

namespace pago::hdl64 {
namespace {

std::uint16_t u16(std::span<const std::uint8_t> packet, std::size_t at) noexcept {
  std::uint16_t value = 0;
  std::memcpy(&value, packet.data() + at, sizeof value);
  return value;
}

std::uint16_t azimuth_cdeg(std::span<const std::uint8_t> packet, int block) noexcept {
  return u16(packet, static_cast<std::size_t>(block) * kBlockBytes + 2);
}

bool is_alternating(std::span<const std::uint8_t> packet) noexcept {
  unsigned differences = 0;
  for (std::size_t block = 0; block < kBlocks; block += 2) {
    differences |= u16(packet, block * kBlockBytes) ^ unsigned { kUpperBlock };
    differences |= u16(packet, (block + 1) * kBlockBytes) ^ unsigned { kLowerBlock };
  }
  return differences == 0;
}

/// The early trailer: two bytes of counter or temperature, then "DegC" or a version such as "V25b" (2008
/// manual, p. 7 and 21).
bool has_text_trailer(std::span<const std::uint8_t> packet) noexcept {
  const std::uint8_t* text = packet.data() + 1202;
  const auto is_digit = [](std::uint8_t c) { return c >= '0' && c <= '9'; };
  const auto is_word = [is_digit](std::uint8_t c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  const bool is_version = (text[0] == 'V' || text[0] == 'v') && is_digit(text[1]) && is_digit(text[2]);
  return std::memcmp(text, "DegC", 4) == 0 || (is_version && is_word(text[3]));
}

/// The median of those differences that can be a packet period; 0 if they are too few.
template <typename Difference>
std::int64_t median_period_ns(std::size_t num_packets, Difference difference_ns) noexcept {
  constexpr std::int64_t kShortest_ns = 50'000, kLongest_ns = 10'000'000;
  std::array<std::int64_t, 64> periods_ns{};
  std::size_t n = 0;
  for (std::size_t i = 1; i < num_packets; ++i) {
    const std::int64_t period_ns = difference_ns(i);
    if (period_ns >= kShortest_ns && period_ns <= kLongest_ns) periods_ns[n++] = period_ns;
  }
  if (n < 4) return 0;
  const auto middle = periods_ns.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::nth_element(periods_ns.begin(), middle, periods_ns.begin() + static_cast<std::ptrdiff_t>(n));
  return *middle;
}

bool is_about(std::int64_t period_ns, std::int64_t nominal_ns) noexcept {
  return period_ns * 100 > nominal_ns * 94 && period_ns * 100 < nominal_ns * 106;
}

}  // namespace

StreamProbe::Flags StreamProbe::classify(std::span<const std::uint8_t> packet) noexcept {
  if (is_alternating(packet)) return kAlternating;
  int upper = 0, lower = 0, further = 0;
  for (int block = 0; block < kBlocks; ++block) {
    const std::uint16_t flag = u16(packet, static_cast<std::size_t>(block) * kBlockBytes);
    upper += flag == kUpperBlock;
    lower += flag == kLowerBlock;
    further += flag == 0xCCFF || flag == 0xBBFF;  // banks of lasers 64-95 and 96-127
  }
  if (upper == kBlocks) return kUpperOnly;
  if (upper + lower == kBlocks && upper > lower) return kMoreUpper;
  return further >= 2 && upper + lower + further == kBlocks ? kFourBanks : kOther;
}

void StreamProbe::note_azimuths(std::span<const std::uint8_t> packet, Flags flags) noexcept {
  // A firing is two blocks of an HDL-64E, one of the others; dual return sends each firing twice.
  const int blocks_per_firing = flags == kAlternating ? 2 : 1;
  bool repeats = true;
  for (int block = 0; block < kBlocks; block += 2 * blocks_per_firing)
    repeats &= azimuth_cdeg(packet, block) == azimuth_cdeg(packet, block + blocks_per_firing);
  repeats_ = static_cast<std::uint8_t>(repeats_ + repeats);
  turning_ = static_cast<std::uint8_t>(turning_ + (azimuth_cdeg(packet, 0) != azimuth_cdeg(packet, 11)));
}

void StreamProbe::add(std::span<const std::uint8_t> payload, std::int64_t arrival_ns) noexcept {
  if (decided_) return;
  if (payload.size() != kPacketBytes) {
    decided_ = ++foreign_ >= kMaxForeign;
    return;
  }
  const Flags flags = classify(payload);
  ++votes_[flags];
  note_azimuths(payload, flags);
  texts_ = static_cast<std::uint8_t>(texts_ + (flags == kAlternating && has_text_trailer(payload)));
  if (flags == kUpperOnly) model_byte_ = payload[1205];
  std::memcpy(&stamps_us_[size_], payload.data() + 1200, sizeof stamps_us_[0]);
  arrivals_ns_[size_] = arrival_ns;
  if (++size_ >= kPackets) decide();
}

void StreamProbe::decide() noexcept {
  const auto most = std::max_element(votes_.begin(), votes_.end());
  if (2U * *most > size_) {
    kind_ = conclude(static_cast<Flags>(most - votes_.begin()));
    decided_ = true;
  }
  decided_ |= size_ == kMaxPackets;
}

SensorKind StreamProbe::conclude(Flags flags) const noexcept {
  switch (flags) {
    case kAlternating:
      return among_hdl64();
    case kMoreUpper:
      return SensorKind::kHdl64S1;
    case kUpperOnly:
      return among_one_bank();
    case kFourBanks:
      return SensorKind::kVls128;
    case kOther:
    case kNumFlags:
      break;
  }
  return SensorKind::kUnknown;
}

// Repeated azimuths alone do not prove dual return: a head at rest repeats them too, and one that turns at 5
// Hz now and then, when its encoder has not stepped on. The time between packets decides, where it is known.
SensorKind StreamProbe::among_hdl64() const noexcept {
  if (2U * texts_ > size_) return SensorKind::kHdl64EarlyS2;
  const std::int64_t period_ns = packet_period_ns();
  const bool repeats = 10U * repeats_ >= 9U * votes_[kAlternating];
  const bool is_dual_paced = is_about(period_ns, 172'800);
  const bool is_single_paced = is_about(period_ns, 288'000) || is_about(period_ns, 345'600);
  const bool is_turning = 2U * turning_ > size_;
  return repeats && (is_dual_paced || (is_turning && !is_single_paced)) ? SensorKind::kHdl64Dual
                                                                        : SensorKind::kHdl64Single;
}

// Their firings last 46.08 us (HDL-32E) and 55.296 us (VLP-16, two in a block; VLP-32C); a packet holds
// twelve blocks, and half as much time in dual-return mode.
SensorKind StreamProbe::among_one_bank() const noexcept {
  const std::int64_t period_ns = packet_period_ns();
  if (is_about(period_ns, 552'960) || is_about(period_ns, 276'480)) return SensorKind::kHdl32;
  if (is_about(period_ns, 1'327'104)) return SensorKind::kVlp16;
  if (is_about(period_ns, 331'776)) return SensorKind::kVlp32c;
  if (is_about(period_ns, 663'552) && 2U * turning_ > size_)
    return 2U * repeats_ > size_ ? SensorKind::kVlp16 : SensorKind::kVlp32c;
  switch (model_byte_) {
    case 0x21:
      return SensorKind::kHdl32;
    case 0x22:
    case 0x24:
      return SensorKind::kVlp16;
    case 0x28:
      return SensorKind::kVlp32c;
    default:
      return SensorKind::kOneBank;
  }
}

std::int64_t StreamProbe::packet_period_ns() const noexcept {
  const std::int64_t by_stamp_ns = median_period_ns(size_, [this](std::size_t i) {
    const std::int64_t passed_us = static_cast<std::int64_t>(stamps_us_[i]) - stamps_us_[i - 1];
    return 1000 * (passed_us < 0 ? passed_us + kStampWrap_us : passed_us);
  });
  if (by_stamp_ns != 0) return by_stamp_ns;
  return median_period_ns(size_, [this](std::size_t i) { return arrivals_ns_[i] - arrivals_ns_[i - 1]; });
}

}  // namespace pago::hdl64
