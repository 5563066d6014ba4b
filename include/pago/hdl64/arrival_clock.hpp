// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "pago/hdl64/rotation_tracker.hpp"

namespace pago::hdl64 {

/// Sensor time for packets without time stamps (S1, S2 of 2008): packets come at a constant period, and the
/// head, which turns steadily, tells how many periods have passed. Arrival only has to tell whole turns
/// apart, so it may jitter by almost half a turn; a time is exact up to the constant delay of the first
/// packet and the error of the period, and a lost, doubled or overtaken packet is known as such. At rest
/// packets count as following each other, except over silences of more than 20 ms.
///
/// [ingest thread] real-time safe.
class ArrivalClock {
 public:
  void set_format(const StreamFormat& format, const AzimuthTimes& times) noexcept;

  /// Sensor time of a packet's first firing, a whole number of packet periods after that of the first packet.
  /// Does not rise for a packet that was here before, or was overtaken.
  std::int64_t read(const PacketAzimuths& azimuths, std::int64_t arrival_ns) noexcept;

 private:
  std::int64_t periods(double turned_rev, double elapsed) const noexcept;

  std::int64_t packet_period_ns_ = kPacketPeriod_ns;
  int last_sample_ = kFirings - 1;
  double samples_share_ = 1.0;  // of a packet period that lies between a packet's first and last azimuth

  bool started_ = false;
  std::int64_t time_ns_ = 0, arrival_ns_ = 0;  // of the newest packet
  std::uint16_t azimuth_cdeg_ = 0;
  double turn_rev_ = 0.0;  // per packet period, smoothed
};

}  // namespace pago::hdl64
