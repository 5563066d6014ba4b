// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <span>

#include "pago/core/sources.hpp"

namespace pago {

/// For those who have packets already, from a driver or a bus of their own: the source that a pipeline reads
/// what they submit from.
///
///   pago::PacketInbox inbox;
///   std::jthread thread([&] { pipeline.run(inbox, calibration, observer, stop); });
///   ... inbox.submit(bytes, arrival_ns) for each packet, from one thread ...
///   inbox.close();
///
/// Poses come to the pipeline's observer. [set-up] constructor; [submitting thread] submit() and close(),
/// wait-free, no system call; [ingest thread] the rest, which looks for packets every 2 ms.
class PacketInbox final : public PacketSource {
 public:
  /// Longest payload taken; an HDL-64E sends 1,206 bytes.
  static constexpr std::size_t kMaxPayloadBytes = 2048;

  /// Room for `capacity` packets that wait, rounded up to a power of two: 4,096 hold 1.2 s of an HDL-64E
  /// in 8.5 MB.
  explicit PacketInbox(std::uint32_t capacity = 4096);
  ~PacketInbox() override;

  /// Copies a packet in. False, and counted as truncated (longer than kMaxPayloadBytes) or as dropped
  /// (SourceCounters::kernel_dropped: no room), if it cannot be taken.
  bool submit(std::span<const std::uint8_t> payload, std::int64_t arrival_ns) noexcept;

  /// No more packets will come: the pipeline uses what is there and ends.
  void close() noexcept;

  std::span<const Datagram> receive() noexcept override;
  bool all_done() const noexcept override;
  SourceCounters counters() const noexcept override;
  Progress progress() const noexcept override { return {}; }
  std::string complaint() const override { return {}; }

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
