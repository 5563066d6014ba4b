// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "pago/config/drivers.hpp"
#include "pago/core/sources.hpp"

namespace pago {

/// Every datagram that was to be recorded has one fate. offered = written + no_room + failed + waiting.
struct RecordCounters {
  std::uint64_t offered = 0;
  std::uint64_t written = 0;  ///< in a file, or in one that was not kept
  std::uint64_t no_room = 0;  ///< the disk was too slow and the buffer full; or longer than 2,048 bytes
  std::uint64_t failed = 0;   ///< the disk took nothing
  std::uint64_t waiting = 0;  ///< in the buffer; 0 after finish()
  std::uint64_t bytes = 0, files = 0;

  std::uint64_t unwritten() const noexcept { return no_room + failed; }
};

/// Keeps datagrams in captures that replay exactly: bytes, order, arrival to the nanosecond, sender and
/// ports. A thread of its own writes, through a buffer: who hands datagrams over never waits. A disk that is
/// full is tried again every second; until it takes something, what comes is lost to the recording, counted,
/// and every file stays readable to its end. A program that is killed loses the last second.
///
/// Files are numbered where their size is limited (RecordConfig). [set-up] constructor; [one thread] add() is
/// real-time safe, finish() waits for the disk; [any thread] counters().
class PcapRecorder {
 public:
  /// Makes the first file. Throws Error if that cannot be done.
  explicit PcapRecorder(const RecordConfig& config);
  ~PcapRecorder();

  void add(const Datagram& datagram) noexcept;
  /// Writes what waits and ends the thread; add() must not be called any more.
  void finish() noexcept;

  RecordCounters counters() const noexcept;
  /// [after finish()] Empty, or what is missing in the files and why.
  std::string complaint() const;
  /// The file, or the first and the last of them that were kept: "a_0001.pcap ... a_0007.pcap".
  std::string files() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace pago
