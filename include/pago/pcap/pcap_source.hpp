// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>

#include "pago/config/drivers.hpp"
#include "pago/core/sources.hpp"

namespace pago {

/// Replays the UDP datagrams of a capture file as fast as they are asked for: whatever tcpdump, Wireshark or
/// VeloView write. Reads pcap and pcapng of either byte order, microsecond and nanosecond stamps; Ethernet
/// (with 802.1Q and 802.1ad tags), Linux cooked v1 and v2, raw IP, BSD loopback; IPv4 with options, IPv6
/// with extension headers, IP fragments in any order. UDP checksums are not verified: the sensor sends none.
///
/// What is counted (SourceCounters): `truncated` are datagrams of which the capture holds only a part (snap
/// length, file cut inside a record) or which are longer than kMaxPayloadBytes; records whose own headers
/// already rule them out are `filtered` even if shortened. A datagram in fragments counts when its fate is
/// known. Fragments of other protocols than UDP count once per datagram, as filtered.
///
/// A part of the capture may be chosen by its own stamps (CaptureConfig); what lies outside is not counted.
///
/// [set-up] the constructor allocates everything; [ingest thread] all the rest. receive() reads the file and
/// allocates nothing itself (libpcap enlarges its buffer when a record is longer than any before it).
class PcapSource final : public PacketSource {
 public:
  static constexpr std::size_t kBatch = 64;
  /// Longest payload handed on; an HDL-64E sends 1,206 bytes.
  static constexpr std::size_t kMaxPayloadBytes = 2048;

  /// Throws Error if the file cannot be read, is no capture, has a link layer that carries no IP, or if the
  /// filter is not valid.
  explicit PcapSource(const std::filesystem::path& file,
                      const PacketFilterConfig& filter = {},
                      const CaptureConfig& part = {});
  ~PcapSource() override;

  std::span<const Datagram> receive() noexcept override;
  bool all_done() const noexcept override;
  SourceCounters counters() const noexcept override;
  /// In bytes of the file, or seconds where a duration was chosen; total 0 when it is a pipe.
  Progress progress() const noexcept override;
  /// Where and why reading ended early and how much was used. [any but the hot path] allocates.
  std::string complaint() const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
