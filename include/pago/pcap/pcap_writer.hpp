// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace pago {

/// Who sends a datagram to whom; the defaults are an HDL-64E's (2008 manual, p. 20). Host byte order.
struct UdpEndpoints {
  std::uint32_t source_ipv4 = 0xC0A8032B;       ///< 192.168.3.43
  std::uint32_t destination_ipv4 = 0xC0A803FF;  ///< 192.168.3.255: broadcast
  std::uint16_t source_port = 443, destination_port = 2368;
};

/// Writes UDP datagrams to a capture file: classic pcap, nanosecond stamps, Ethernet and IPv4 headers made up
/// around each. Records reach the file in order and several at a time. What a full disk cuts off is taken
/// back, so that the file always ends with a whole record.
///
/// [set-up] the constructor; [one thread] the rest: no allocation but for a complaint; blocks on the disk, so
/// never on a real-time thread.
class PcapWriter {
 public:
  /// Longest payload, as of the sources. Longer than an Ethernet frame's, for datagrams that came in pieces.
  static constexpr std::size_t kMaxPayloadBytes = 2048;

  /// Makes the file, or empties it; Error when that cannot be done, or nothing can be written to it.
  explicit PcapWriter(std::filesystem::path file);
  /// Writes what is left; call flush() and look at complaint() to know that it worked.
  ~PcapWriter();
  PcapWriter(const PcapWriter&) = delete;
  PcapWriter& operator=(const PcapWriter&) = delete;

  /// Longer payloads are refused with a complaint.
  void write(std::span<const std::uint8_t> payload,
             std::int64_t arrival_ns,
             const UdpEndpoints& endpoints = {}) noexcept;
  /// Hands all records to the operating system.
  void flush() noexcept;
  /// After a complaint: tries again with the records that come.
  void resume() noexcept { complaint_.clear(); }

  /// In the file, or still held back.
  std::uint64_t records() const noexcept { return records_; }
  std::uint64_t bytes() const noexcept { return bytes_; }
  /// Records that never reached the file.
  std::uint64_t lost() const noexcept { return lost_; }
  /// Empty, or why the file is incomplete: "drive.pcap: cannot be written: No space left on device". After
  /// that nothing more is written. Certain only after flush().
  const std::string& complaint() const noexcept { return complaint_; }

 private:
  void lose_held(const std::string& why) noexcept;

  std::filesystem::path file_;
  int descriptor_ = -1;
  std::vector<std::uint8_t> held_;
  std::size_t held_size_ = 0;
  std::uint64_t num_held_ = 0;
  std::uint64_t records_ = 0, bytes_ = 0, lost_ = 0;
  std::string complaint_;
};

}  // namespace pago
