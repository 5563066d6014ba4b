// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "pago/assembly/stream_survey.hpp"
#include "pago/config/hdl64.hpp"

namespace pago::app {

/// What `pago inspect` has found out about a stream of packets.
struct Inspection {
  std::string source;
  double seconds = 0.0;  ///< from the first packet to the last, by arrival
  SourceCounters counters;
  const StreamSurvey& survey;
  std::optional<hdl64::Calibration> calibration;  ///< given, or found beside
  Hdl64Config config;
  std::string complaint;  ///< of the source, if it ended early
};

/// "HDL-64E S3, dual return": as far as the stream tells.
std::string model_of(const PacketIngest& ingest);

/// One screen for the terminal.
std::string inspection_text(const Inspection& inspection);
/// The same as one JSON object.
std::string inspection_json(const Inspection& inspection);

}  // namespace pago::app
