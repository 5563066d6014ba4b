// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pago/assembly/packet_ingest.hpp"

namespace pago {

/// One of those who send datagrams.
struct Sender {
  std::uint32_t ipv4 = 0;  ///< host byte order; 0: unknown
  std::uint16_t port = 0, destination_port = 0;
  std::uint64_t datagrams = 0;
  std::uint64_t packets = 0;                               ///< of 1,206 bytes
  hdl64::SensorKind sensor = hdl64::SensorKind::kUnknown;  ///< kUnknown: too few to tell
};

/// Looks at a stream before it is used, or instead: who sends, which sensor it is, how it turns, what it says
/// of itself, its own calibration. Makes no sweeps. Not real-time: allocates for each new sender.
class StreamSurvey {
 public:
  /// `calibration`: to hold the sensor's own against; without one nothing is compared.
  explicit StreamSurvey(const Hdl64Config& sensor = {},
                        const std::optional<hdl64::Calibration>& calibration = std::nullopt);
  ~StreamSurvey();

  void add(const Datagram& datagram);
  /// One that is not asked for: only its sender is noted.
  void note_sender(const Datagram& datagram);
  /// The stream is over.
  void finish();

  /// Everything about the HDL-64E that was found, or about the first sender if there is none.
  const PacketIngest& ingest() const noexcept;
  std::vector<Sender> senders() const;

  /// The sensor's own calibration, once it is whole.
  std::optional<hdl64::Calibration> calibration() const;
  /// A sentence for the user if the calibration given is another unit's; empty if it is not, or not yet
  /// known.
  std::string complaint() const;

 private:
  class Nowhere;
  struct Seen {
    Sender sender;
    hdl64::StreamProbe probe;
  };

  Hdl64Config config_;
  std::optional<std::string> compared_with_;
  std::unique_ptr<Nowhere> nowhere_;
  std::unique_ptr<PacketIngest> ingest_;
  std::map<std::uint64_t, Seen> seen_;
};

}  // namespace pago
