// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <span>
#include <vector>

namespace pago::test {

struct CapturedPacket {
  std::int64_t arrival_ns = 0;
  std::vector<std::uint8_t> payload;
};

/// The UDP payloads sent to `port` in a plain capture (little-endian pcap, microseconds, Ethernet, IPv4
/// unfragmented): enough for the recordings, and independent of the product's reader.
inline std::vector<CapturedPacket> read_capture(
    const std::filesystem::path& path,
    std::size_t max_packets = std::numeric_limits<std::size_t>::max(),
    int port = 2368) {
  std::vector<CapturedPacket> packets;
  std::ifstream file(path, std::ios::binary);
  file.seekg(24);
  struct {
    std::uint32_t seconds, microseconds, captured, original;
  } record;
  std::vector<std::uint8_t> frame;
  while (packets.size() < max_packets && file.read(reinterpret_cast<char*>(&record), sizeof record)) {
    frame.resize(record.captured);
    if (!file.read(reinterpret_cast<char*>(frame.data()), record.captured)) break;
    const std::size_t udp = 14 + (frame[14] & 15U) * 4U;
    const bool is_udp = frame[12] == 0x08 && frame[13] == 0x00 && frame[23] == 17;
    if (!is_udp || frame[udp + 2] * 256 + frame[udp + 3] != port) continue;
    packets.push_back({(record.seconds * std::int64_t{1'000'000} + record.microseconds) * 1000,
                       {frame.begin() + static_cast<std::ptrdiff_t>(udp) + 8, frame.end()}});
  }
  return packets;
}

}  // namespace pago::test
