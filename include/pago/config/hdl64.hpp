// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// What vertOffset shifts: the height alone ("vertical", the manual's formula), or the beam's origin
/// perpendicular to the beam ("perpendicular", as the ROS driver and VeloView compute; moves the lowest laser
/// by 5 cm). Neither units nor files tell which is theirs.
enum class VerticalOffset : std::uint8_t { kVertical, kPerpendicular };

/// Which instant a packet's device stamp names; the two readings differ by one packet, 288 us. Manuals do not
/// say: velodyne_decoder reads the first, VeloView the second.
enum class PacketStamp : std::uint8_t {
  kFirstFiring,  ///< the start of the packet's first firing
  kLastFiring    ///< the end of the packet's last firing
};

/// [hdl64]
struct Hdl64Config {
  std::string calibration;
  VerticalOffset vertical_offset = VerticalOffset::kVertical;
  PacketStamp packet_stamp = PacketStamp::kFirstFiring;
  double min_range_m = 0.9;
  double max_range_m = 120.0;
};

template <typename Visitor>
void describe(Visitor& v, Hdl64Config& c) {
  v("calibration", c.calibration,
    "the unit's db.xml or ROS yaml file; `sensor`: the one that it sends itself (S2.1, S3); empty: a file "
    "beside the capture, else the sensor's");
  v("vertical_offset", c.vertical_offset,
    choices(std::pair{"vertical", VerticalOffset::kVertical},
            std::pair{"perpendicular", VerticalOffset::kPerpendicular}),
    "what the calibration's vertOffset shifts: the height, or the beam perpendicular to itself");
  v("packet_stamp", c.packet_stamp,
    choices(std::pair{"first_firing", PacketStamp::kFirstFiring},
            std::pair{"last_firing", PacketStamp::kLastFiring}),
    "which instant the device stamp names: the packet's first firing, or the end of its last");
  v("min_range_m", c.min_range_m, within(0.0, 10.0),
    "nearer returns are ignored; below 0.9 m the sensor is blind");
  v("max_range_m", c.max_range_m, within(1.0, 135.0), "farther returns are ignored");
}

}  // namespace pago
