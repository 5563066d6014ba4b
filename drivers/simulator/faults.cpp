// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "faults.hpp"

#include <algorithm>
#include <cstring>

namespace pago::simulator {
namespace {

enum : std::uint64_t { kFault = 1100 };

constexpr int kLatest = 3;  // packets
constexpr std::int64_t kRightAfter_ns = 1000;
constexpr double kPause_s = 1.5, kOff_s = 4.0;
constexpr double kPacketsPerMinute = 60.0 / 288e-6;
constexpr std::size_t kStampAt = 1200;

bool is_within(double t_s, double from_s, double length_s) {
  return from_s > 0.0 && t_s >= from_s && t_s < from_s + length_s;
}

}  // namespace

FaultyWay::FaultyWay(const SimulatorFaults& faults, std::int64_t start_ns, std::uint64_t seed)
    : faults_(faults), start_ns_(start_ns), seed_(seed) {
  late_.reserve(kMost);
}

bool FaultyWay::is_silent(double t_s) const noexcept {
  return is_within(t_s, faults_.pause_at_s, kPause_s) || is_within(t_s, faults_.power_cycle_at_s, kOff_s);
}

bool FaultyWay::is_in_burst(Random& random) noexcept {
  if (burst_left_ == 0 && random.chance(faults_.bursts_per_min / kPacketsPerMinute))
    burst_left_ = 10 + random.below(91);
  if (burst_left_ == 0) return false;
  --burst_left_;
  return true;
}

void FaultyWay::damage(SentPacket& packet, Random& random) const noexcept {
  if (random.chance(faults_.azimuth_glitches)) {
    const auto block = static_cast<std::size_t>(random.below(static_cast<int>(hdl64::kBlocks)));
    const auto azimuth = static_cast<std::uint16_t>(random.below(65'536));
    std::memcpy(packet.bytes.data() + block * hdl64::kBlockBytes + 2, &azimuth, sizeof azimuth);
  }
  if (random.chance(faults_.corrupted)) {
    const int wrong = 1 + random.below(3);
    for (int i = 0; i < wrong; ++i) {
      const auto at = static_cast<std::size_t>(random.below(static_cast<int>(hdl64::kPacketBytes)));
      packet.bytes[at] = static_cast<std::uint8_t>(packet.bytes[at] ^ (1 + random.below(255)));
    }
  }
  if (random.chance(faults_.truncated))
    packet.size = static_cast<std::size_t>(random.below(static_cast<int>(hdl64::kPacketBytes)));
}

// A sensor without GPS counts from when it is switched on.
void FaultyWay::restart_stamp(SentPacket& packet, double t_s) const noexcept {
  const double since_s = t_s - faults_.power_cycle_at_s - kOff_s;
  if (faults_.power_cycle_at_s <= 0.0 || since_s < 0.0) return;
  const auto stamp_us =
      static_cast<std::uint32_t>(static_cast<std::uint64_t>(since_s * 1e6) % hdl64::kStampWrap_us);
  std::memcpy(packet.bytes.data() + kStampAt, &stamp_us, sizeof stamp_us);
}

void FaultyWay::deliver_late(int packets_later, std::vector<SentPacket>& arrived) {
  for (Late& late : late_) {
    late.after -= packets_later;
    if (late.after > 0) continue;
    if (!arrived.empty())
      late.packet.arrival_ns = std::max(late.packet.arrival_ns, arrived.back().arrival_ns + kRightAfter_ns);
    arrived.push_back(late.packet);
  }
  std::erase_if(late_, [](const Late& late) { return late.after <= 0; });
}

void FaultyWay::pass(const SimulatedPacket& packet, std::vector<SentPacket>& arrived) {
  Random random(seed_, kFault, number_++);
  const double t_s = static_cast<double>(packet.time_ns - start_ns_) * 1e-9;
  const bool is_lost = random.chance(faults_.lost), is_missed = is_in_burst(random);
  if (!is_lost && !is_missed && !is_silent(t_s)) {
    SentPacket sent{packet.bytes, hdl64::kPacketBytes, packet.arrival_ns};
    restart_stamp(sent, t_s);
    damage(sent, random);
    if (random.chance(faults_.reordered) && late_.size() < kMost / 2) {
      late_.push_back({sent, 2 + random.below(kLatest)});
    } else {
      arrived.push_back(sent);
      if (random.chance(faults_.duplicated)) {
        sent.arrival_ns += kRightAfter_ns;
        arrived.push_back(sent);
      }
    }
  }
  deliver_late(1, arrived);
}

void FaultyWay::finish(std::vector<SentPacket>& arrived) {
  deliver_late(kLatest + 1, arrived);
}

}  // namespace pago::simulator
