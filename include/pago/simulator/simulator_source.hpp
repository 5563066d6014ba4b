// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pago/core/sources.hpp"
#include "pago/simulator/packet_labels.hpp"
#include "pago/simulator/simulator.hpp"

namespace pago {

/// A simulated drive as a source of packets, rendered while it is asked for: `pago run sim:urban` needs no
/// file, however long the drive. As fast as rendering goes; like a replay, it waits for the pipeline.
///
/// [set-up] the constructor; [ingest thread] receive(), which casts rays and allocates when new land comes
/// into sight: a source for replays, not for a live pipeline.
class SimulatorSource final : public PacketSource {
 public:
  /// Throws Error as simulator::Simulator does.
  SimulatorSource(const SimulatorConfig& config, const Hdl64Config& sensor, const Mount& mount);
  ~SimulatorSource() override;

  std::span<const Datagram> receive() noexcept override;
  bool all_done() const noexcept override { return has_ended_; }
  SourceCounters counters() const noexcept override { return counters_; }
  /// In packets.
  Progress progress() const noexcept override;
  /// Rendering that broke off: memory ran out, say.
  std::string complaint() const override { return complaint_; }
  bool has_labels() const noexcept override { return true; }
  void label(Sweep& sweep) const noexcept override { labels_.label(sweep, simulator_.calibration()); }

  /// The calibration to decode with.
  const hdl64::Calibration& calibration() const noexcept { return simulator_.calibration(); }
  /// The truth.
  const simulator::Simulator& drive() const noexcept { return simulator_; }
  /// Classes of the returns of the last 16,384 packets (4.7 s): enough for every sweep in flight. Another
  /// thread may label a sweep once it was handed on, since its packets were added before.
  const simulator::LabelTrack& labels() const noexcept { return labels_; }

 private:
  static constexpr std::size_t kBatch = 8;
  static constexpr std::size_t kRemembered = 16'384;

  struct Arrivals;

  simulator::Simulator simulator_;
  simulator::LabelTrack labels_;
  std::unique_ptr<Arrivals> arrivals_;  // what faults leave of the packets
  simulator::SimulatedPacket packet_;
  std::vector<Datagram> datagrams_;
  std::uint64_t packets_done_ = 0;
  bool has_ended_ = false;
  SourceCounters counters_;
  std::string complaint_;
};

}  // namespace pago
