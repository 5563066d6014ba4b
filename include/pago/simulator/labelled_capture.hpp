// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "pago/pcap/pcap_source.hpp"
#include "pago/simulator/packet_labels.hpp"

namespace pago {

/// A capture of simulated packets with the file of labels that `pago simulate` wrote beside it: as the
/// capture alone, but sweeps made of it can be labelled. Same life as PcapSource.
class LabelledCapture final : public PacketSource {
 public:
  /// Throws Error as PcapSource and LabelTrack do. `unit` is the calibration that the packets are decoded
  /// with.
  LabelledCapture(const std::filesystem::path& capture,
                  const PacketFilterConfig& filter,
                  const CaptureConfig& part,
                  const std::filesystem::path& labels,
                  const hdl64::Calibration& unit)
      : packets_(capture, filter, part), labels_(labels), unit_(unit) {}

  std::span<const Datagram> receive() noexcept override { return packets_.receive(); }
  bool all_done() const noexcept override { return packets_.all_done(); }
  SourceCounters counters() const noexcept override { return packets_.counters(); }
  Progress progress() const noexcept override { return packets_.progress(); }
  std::string complaint() const override { return packets_.complaint(); }
  bool has_labels() const noexcept override { return true; }
  void label(Sweep& sweep) const noexcept override { labels_.label(sweep, unit_); }

 private:
  PcapSource packets_;
  simulator::LabelTrack labels_;
  hdl64::Calibration unit_;
};

}  // namespace pago
