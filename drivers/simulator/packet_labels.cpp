// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/packet_labels.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "pago/core/error.hpp"
#include "surface.hpp"
#include "timing.hpp"

namespace pago::simulator {
namespace {

constexpr std::string_view kMagic = "PaGO-LB1";
constexpr std::int64_t kHour_ns = 3'600'000'000'000;
/// Device stamps are cut to microseconds.
constexpr std::int64_t kStampStep_ns = 1'000;

constexpr std::array kKinds{
    Label::kUnlabelled,   Label::kOutlier,        Label::kCar,         Label::kTruck,       Label::kPerson,
    Label::kRoad,         Label::kParking,        Label::kSidewalk,    Label::kOtherGround, Label::kBuilding,
    Label::kFence,        Label::kOtherStructure, Label::kLaneMarking, Label::kVegetation,  Label::kTrunk,
    Label::kTerrain,      Label::kPole,           Label::kTrafficSign, Label::kOtherObject, Label::kMovingCar,
    Label::kMovingPerson, Label::kMovingTruck};

/// By class number, which is below 260.
constexpr auto kKindOfClass = [] {
  std::array<std::uint8_t, 260> kinds{};
  for (std::size_t kind = 0; kind < kKinds.size(); ++kind)
    kinds[static_cast<std::size_t>(kKinds[kind])] = static_cast<std::uint8_t>(kind);
  return kinds;
}();

PacketLabels to_kinds(const SimulatedPacket& packet) noexcept {
  PacketLabels result{.time_ns = packet.time_ns};
  for (std::size_t i = 0; i < kSlotsPerPacket; ++i) result.kinds[i] = kKindOfClass[packet.labels[i]];
  return result;
}

struct FileHeader {
  std::array<char, 8> magic{};
  std::uint32_t firing_period_ns = 0, firings = 0, num_kinds = 0;
};

bool is_timing(std::int64_t period_ns, std::uint32_t firings) noexcept {
  return std::ranges::any_of(
      std::array{kSingleReturn, kSingleReturnS3, kDualReturn}, [&](const FiringTiming& known) {
        return known.period_ns == period_ns && known.firings == static_cast<int>(firings);
      });
}

template <typename T>
std::string_view bytes_of(const T& value) {
  return {reinterpret_cast<const char*>(&value), sizeof value};
}

}  // namespace

LabelTrack::LabelTrack(std::size_t capacity, std::int64_t firing_period_ns, int firings_per_packet)
    : packets_(capacity), firing_period_ns_(firing_period_ns), firings_(firings_per_packet) {}

LabelTrack::LabelTrack(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw Error(file.string(), "cannot be opened", "it holds the labels of simulated packets");
  FileHeader header;
  in.read(reinterpret_cast<char*>(&header), sizeof header);
  std::array<std::uint16_t, kKinds.size()> classes{};
  in.read(reinterpret_cast<char*>(classes.data()), sizeof classes);
  const bool is_ours = in && std::ranges::equal(header.magic, kMagic) && header.num_kinds == kKinds.size() &&
                       is_timing(header.firing_period_ns, header.firings) &&
                       std::ranges::equal(classes, kKinds, {}, {},
                                          [](Label label) { return static_cast<std::uint16_t>(label); });
  if (!is_ours)
    throw Error(file.string(), "is no file of packet labels of this version", "render the drive again");
  firing_period_ns_ = header.firing_period_ns;
  firings_ = static_cast<int>(header.firings);
  const std::uintmax_t rest = std::filesystem::file_size(file) - sizeof header - sizeof classes;
  packets_.resize(rest / sizeof(PacketLabels));
  size_ = packets_.size();
  in.read(reinterpret_cast<char*>(packets_.data()),
          static_cast<std::streamsize>(size_ * sizeof(PacketLabels)));
  if (!in || rest % sizeof(PacketLabels) != 0)
    throw Error(file.string(), "ends inside a packet's labels", "render the drive again");
}

void LabelTrack::add(const SimulatedPacket& packet) noexcept {
  packets_[(oldest_ + size_) % packets_.size()] = to_kinds(packet);
  if (size_ < packets_.size())
    ++size_;
  else
    oldest_ = (oldest_ + 1) % packets_.size();
}

const PacketLabels& LabelTrack::at(std::size_t age) const noexcept {
  return packets_[(oldest_ + age) % packets_.size()];
}

const PacketLabels* LabelTrack::find(std::int64_t time_ns) const noexcept {
  if (size_ == 0) return nullptr;
  const std::int64_t period_ns = firing_period_ns_ * firings_;
  // Newest first: a live run's sweeps are of the last packets.
  std::size_t low = 0, high = size_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (at(middle).time_ns <= time_ns)
      low = middle + 1;
    else
      high = middle;
  }
  if (low == 0 || time_ns - at(low - 1).time_ns >= period_ns) return nullptr;
  return &at(low - 1);
}

// A replay's clock may be off by whole hours, which device stamps do not tell.
std::int64_t LabelTrack::hours_off_ns(std::int64_t start_ns) const noexcept {
  if (size_ == 0) return 0;
  const std::int64_t first_ns = at(0).time_ns, last_ns = at(size_ - 1).time_ns;
  if (start_ns >= first_ns && start_ns <= last_ns) return 0;
  const std::int64_t off_ns = first_ns / 2 + last_ns / 2 - start_ns;
  const std::int64_t half_ns = off_ns < 0 ? -kHour_ns / 2 : kHour_ns / 2;
  return (off_ns + half_ns) / kHour_ns * kHour_ns;
}

std::uint32_t LabelTrack::label(Sweep& sweep, const hdl64::Calibration& unit) const noexcept {
  std::array<int, kNumRings> laser_of_ring{};
  for (int laser = 0; laser < kNumRings; ++laser)
    laser_of_ring[unit.ring_of_laser[static_cast<std::size_t>(laser)]] = laser;
  const std::int64_t shift_ns = kStampStep_ns + hours_off_ns(sweep.header.start_ns);
  const FiringTiming timing{firing_period_ns_, firings_};
  std::uint32_t known = 0;
  const PacketLabels* packet = nullptr;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const int laser = laser_of_ring[sweep.ring[i]];
    const std::int64_t firing_ns =
        sweep.header.start_ns + shift_ns + sweep.time_offset_ns[i] - timing.laser_ns(laser);
    const bool is_same = packet != nullptr && firing_ns >= packet->time_ns &&
                         firing_ns - packet->time_ns < timing.packet_period_ns();
    if (!is_same) packet = find(firing_ns);
    sweep.label[i] = 0;
    if (packet == nullptr) continue;
    const std::int64_t firing = (firing_ns - packet->time_ns) / timing.period_ns;
    const std::size_t blocks_per_firing = hdl64::kBlocks / static_cast<std::size_t>(timing.firings);
    // The strongest stands in a firing's first two blocks, what else came in the next two.
    const bool is_second = blocks_per_firing == 4 && (sweep.echo[i] & kNotStrongest) != 0;
    const std::size_t block =
        static_cast<std::size_t>(firing) * blocks_per_firing + (is_second ? 2 : 0) + (laser >= 32 ? 1 : 0);
    const std::uint8_t kind =
        packet->kinds[block * hdl64::kLasersPerBlock + static_cast<std::size_t>(laser % 32)];
    sweep.label[i] = static_cast<std::uint16_t>(kKinds[std::min<std::size_t>(kind, kKinds.size() - 1)]);
    ++known;
  }
  sweep.header.flags |= kLabelled;
  return known;
}

LabelWriter::LabelWriter(std::filesystem::path file, std::int64_t firing_period_ns, int firings_per_packet)
    : file_(std::move(file)) {
  FileHeader header;
  std::ranges::copy(kMagic, header.magic.begin());
  header.firing_period_ns = static_cast<std::uint32_t>(firing_period_ns);
  header.firings = static_cast<std::uint32_t>(firings_per_packet);
  header.num_kinds = kKinds.size();
  file_.write(bytes_of(header));
  for (const Label label : kKinds) file_.write(bytes_of(static_cast<std::uint16_t>(label)));
}

void LabelWriter::write(const SimulatedPacket& packet) noexcept {
  file_.write(bytes_of(to_kinds(packet)));
}

}  // namespace pago::simulator
