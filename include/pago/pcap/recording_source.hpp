// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/core/sources.hpp"
#include "pago/pcap/pcap_recorder.hpp"

namespace pago {

/// A source that records what it hands on. Holds references: both must outlive it. [ingest thread] as
/// real-time safe as the source.
class RecordingSource final : public PacketSource {
 public:
  RecordingSource(PacketSource& source, PcapRecorder& recorder) noexcept
      : source_(source), recorder_(recorder) {}

  std::span<const Datagram> receive() noexcept override;
  bool all_done() const noexcept override { return source_.all_done(); }
  SourceCounters counters() const noexcept override { return source_.counters(); }
  Progress progress() const noexcept override { return source_.progress(); }
  std::string complaint() const override { return source_.complaint(); }
  bool has_labels() const noexcept override { return source_.has_labels(); }
  void label(Sweep& sweep) const noexcept override { source_.label(sweep); }

 private:
  PacketSource& source_;
  PcapRecorder& recorder_;
};

}  // namespace pago
