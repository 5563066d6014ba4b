// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "pago/core/counters.hpp"
#include "pago/hdl64/stream_format.hpp"

namespace pago {

/// A checked packet with its times. The bytes belong to whoever made it.
struct StampedPacket {
  std::span<const std::uint8_t, hdl64::kPacketBytes> bytes;
  std::int64_t time_ns = 0;  ///< sensor time of its first firing
  std::int64_t arrival_ns = 0;

  hdl64::PacketView view() const noexcept { return hdl64::PacketView(bytes); }
};

/// A packet that outlives the receive buffer.
struct PacketCopy {
  std::array<std::uint8_t, hdl64::kPacketBytes> bytes{};
  std::int64_t time_ns = 0, arrival_ns = 0;

  void take(const StampedPacket& packet) noexcept;
  StampedPacket packet() const noexcept { return {bytes, time_ns, arrival_ns}; }
};

/// Puts packets back into the order of their device stamps. A packet that continues the last one passes at
/// once and uncopied. Behind a gap up to `window` packets are held back, until the missing one comes or the
/// window is full; so order costs latency only where something is missing.
///
///   switch (sequencer.offer(packet)) { case kNext: use(packet); ... }
///   while (const auto held = sequencer.take()) use(*held);
///
/// Counts firings by the device's clock: each gap's whole packets are lost ones. [set-up] constructor;
/// [ingest thread] the rest, real-time safe.
class PacketSequencer {
 public:
  enum class Verdict : std::uint8_t {
    kNext,       ///< use it now
    kHeld,       ///< copied; take() gives it back in its turn
    kDuplicate,  ///< seen before (same stamp and azimuth): drop it
    kLate        ///< newer ones have been used already: drop it
  };

  explicit PacketSequencer(int window);

  /// What kind of packets come from now on: single return unless said otherwise.
  void set_format(const hdl64::StreamFormat& format) noexcept;

  Verdict offer(const StampedPacket& packet) noexcept;
  /// The held packet whose turn has come, if any. Valid until the next offer().
  std::optional<StampedPacket> take() noexcept;
  /// The oldest held packet, whether its turn has come or not: at the end of the stream, and before its clock
  /// starts anew.
  std::optional<StampedPacket> take_regardless() noexcept;
  /// The next packet begins a new count of time; nothing may be held.
  void restart() noexcept;

  /// How many packet periods the newest packet that was given out lies behind the one before it; 1 if none is
  /// missing, or there was none before.
  std::int64_t periods_on() const noexcept { return periods_on_; }
  /// So many firings that counted as lost were never sent.
  void excuse(std::uint64_t firings) noexcept;

  const FiringCounters& firings() const noexcept { return firings_; }
  /// Packets of which take() or offer() gave back an older one after a newer one had been held.
  std::uint64_t reordered() const noexcept { return reordered_; }
  std::uint64_t held() const noexcept { return held_; }

 private:
  struct Slot {
    PacketCopy copy;
    bool is_used = false;
  };
  struct Identity {
    std::int64_t time_ns = 0;
    std::uint16_t azimuth_cdeg = 0;
    bool operator==(const Identity&) const = default;
  };
  static Identity identify(const StampedPacket& packet) noexcept {
    return {packet.time_ns, packet.view().block_azimuth_cdeg(0)};
  }

  std::int64_t periods_after_last(std::int64_t time_ns) const noexcept;
  bool is_known(const Identity& packet) const noexcept;
  void emit(const Identity& packet) noexcept;
  std::size_t oldest() const noexcept;
  std::optional<StampedPacket> take_slot(std::size_t slot) noexcept;

  std::int64_t packet_period_ns_ = hdl64::kPacketPeriod_ns;
  std::uint64_t firings_per_packet_ = hdl64::kFirings;
  std::size_t window_;
  std::vector<Slot> slots_;  // one more than the window: room for the packet that overfills it
  std::size_t held_ = 0;
  std::array<Identity, 16> recent_{};  // the last ones used
  std::size_t next_recent_ = 0;
  std::int64_t last_ns_ = 0, periods_on_ = 1;
  bool started_ = false;
  FiringCounters firings_;
  std::uint64_t reordered_ = 0;
};

}  // namespace pago
