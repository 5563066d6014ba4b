// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>

#include "pago/assembly/assembler.hpp"
#include "pago/core/counters.hpp"
#include "pago/core/sources.hpp"
#include "pago/hdl64/sensor_status.hpp"
#include "pago/hdl64/stream_format.hpp"

namespace pago {

/// What the ingest thread knows of the stream at a moment. Plain bytes.
struct IngestStatus {
  Progress progress;
  SourceCounters source;
  PacketCounters packets;
  FiringCounters firings;
  AssemblyCounters sweeps;
  std::int64_t last_delivery_ns = 0;  ///< monotonic clock when datagrams last came; 0: none yet
  double rotation_hz = 0.0;           ///< 0 while the head does not turn
  double clock_drift_ppm = 0.0;       ///< by how much the host's clock is faster than the sensor's
  hdl64::SensorStatus said;           ///< what the sensor says of itself
  std::uint32_t other_sender = 0;     ///< IPv4 of the last one whose packets were left out; 0: none
  hdl64::SensorKind sensor = hdl64::SensorKind::kUnknown;
  bool is_refused = false;            ///< what comes is of another sensor, or of none that can be told
  bool is_calibration_wrong = false;  ///< it is not the one that the sensor sends
  bool is_view_limited = false;       ///< the sensor looks at a part of the circle only
};
static_assert(std::is_trivially_copyable_v<IngestStatus>);

/// What a live stream is doing, in the order in which a user would ask.
enum class StreamState : std::uint8_t {
  kNoData,       ///< nothing has come yet
  kForeign,      ///< datagrams come, but none that the filter takes, or none of an HDL-64E's size
  kOtherSensor,  ///< of a sensor that PaGO does not read
  kSilent,       ///< packets came, and have stopped
  kNotSpinning,  ///< packets come, but the head does not turn
  kRunning,
  kCount
};
std::string_view to_string(StreamState state) noexcept;

/// [any thread]
StreamState stream_state(const IngestStatus& status, std::int64_t now_monotonic_ns) noexcept;

/// The state as a sentence for the user, with its likely cause and what to do. `source`: as the user named
/// it.
std::string explain(StreamState state, const IngestStatus& status, const std::string& source);

}  // namespace pago
