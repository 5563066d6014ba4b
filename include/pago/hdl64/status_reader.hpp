// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "pago/hdl64/calibration.hpp"
#include "pago/hdl64/sensor_status.hpp"

namespace pago::hdl64 {

/// How the calibration in a stream is known to have come through undamaged.
enum class Checksum : std::uint8_t {
  kNone,    ///< neither of these yet
  kLength,  ///< S2, S2.1: the length word 1,820; bytes count when two rounds agree
  kCrc,     ///< S3: CRC-16
  kAgreed   ///< none that fits, but three rounds agree on every byte
};

/// Gathers what a sensor says of itself, two bytes a packet (S2.1 and S3 manuals; hdl64 notes, section 5):
/// time, GPS, temperature and warnings every 16 packets; its calibration and parameters in 260 cycles of 16,
/// again and again (1.2 s, 0.7 s in dual-return mode).
///
/// Lost packets leave holes that later rounds fill: where in the round a byte belongs follows from the number
/// of packets since the last one, counted by the device's clock, so no unbroken round is needed. Each byte is
/// what most rounds say. The round's start is told by its text "UNIT#". A place in the round that the type
/// bytes contradict is given up, and everything gathered with it.
///
/// [ingest thread] real-time safe; [set-up] calibration().
class StatusReader {
 public:
  static constexpr std::size_t kCycles = 260, kCyclePackets = 16, kRoundPackets = kCycles * kCyclePackets;

  /// Takes the next packet's two status bytes; `packets_on`: 1 for the neighbour of the last packet, 2 if one
  /// is missing between them.
  void add(std::uint8_t type, std::uint8_t value, std::int64_t packets_on) noexcept;
  /// How many packets are missing is not known: the sensor's clock restarted, say.
  void lose_place() noexcept;

  const SensorStatus& status() const noexcept { return status_; }
  /// How far the calibration is gathered, 0 to 1; 1 when it is there.
  double progress() const noexcept;

  Checksum checksum() const noexcept { return checksum_; }
  bool has_calibration() const noexcept { return checksum_ != Checksum::kNone; }
  /// How often a whole calibration was read; grows when it is read anew because something changed.
  std::uint32_t readings() const noexcept { return readings_; }
  /// The lasers' figures; has a meaning with has_calibration() only.
  const std::array<LaserCalibration, 64>& lasers() const noexcept { return lasers_; }
  /// A calibration made of them, good to 0.01 degrees and 1 mm, the resolution in which they are sent.
  std::optional<Calibration> calibration(VerticalOffset vertical_offset) const;

 private:
  static constexpr std::size_t kCycleBytes = 7, kBytes = kCycles * kCycleBytes;
  /// A byte that was seen so often must be contradicted as often to be changed.
  static constexpr std::uint8_t kMostVotes = 3;
  /// A packet's place in the round: what was seen there most.
  struct Place {
    std::uint8_t type = 0, value = 0;
    std::uint8_t votes = 0;
  };

  bool contradicts(std::size_t index, std::uint8_t type) const noexcept;
  void vote(std::size_t index, std::uint8_t type, std::uint8_t value) noexcept;
  void read_at_once(std::uint8_t type, std::uint8_t value) noexcept;
  void look_for_start() noexcept;
  void conclude() noexcept;
  Checksum check() const noexcept;
  std::uint16_t crc_of_lasers() const noexcept;
  const Place& place(std::size_t byte) const noexcept;
  std::uint16_t word(std::size_t byte) const noexcept;
  bool read_lasers() noexcept;
  void read_parameters() noexcept;

  std::array<Place, kRoundPackets> places_{};
  std::size_t index_ = 0;  // of the newest packet: multiples of 16 begin a cycle, modulo a round of any start
  std::size_t num_filled_ = 0;
  /// How many of the round's bytes were seen once or oftener, twice or oftener, ...
  std::array<std::size_t, kMostVotes> num_with_votes_{};
  std::optional<std::size_t> start_;  // the index of the round's first packet
  int contradictions_ = 0;
  bool is_placed_ = false;  // the first packet has come
  bool is_news_ = false;    // something changed since conclude()

  SensorStatus status_;
  std::array<LaserCalibration, 64> lasers_{};
  Checksum checksum_ = Checksum::kNone;
  std::uint32_t readings_ = 0;
};

}  // namespace pago::hdl64
