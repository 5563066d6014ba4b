// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

namespace pago::test {

using Octets = std::vector<std::uint8_t>;
using OctetView = std::span<const std::uint8_t>;

// Not inlined: g++ 12 would report overreads that cannot happen inside vector's growth.
[[gnu::noinline]] inline void put_be16(Octets& to, std::size_t value) {
  to.push_back(static_cast<std::uint8_t>(value >> 8 & 0xFF));
  to.push_back(static_cast<std::uint8_t>(value & 0xFF));
}
inline void put_be32(Octets& to, std::uint32_t value) {
  put_be16(to, value >> 16);
  put_be16(to, value & 0xFFFF);
}
[[gnu::noinline]] inline void append(Octets& to, OctetView bytes) {
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Who sends to whom; the defaults are an HDL-64E's.
struct Endpoints {
  std::uint32_t source_ipv4 = 0xC0A8032B;       ///< 192.168.3.43
  std::uint32_t destination_ipv4 = 0xFFFFFFFF;  ///< broadcast
  std::uint16_t source_port = 443, destination_port = 2368;
};

/// UDP header and payload. Checksum 0, as the sensor sends it.
inline Octets udp(OctetView payload, const Endpoints& who = {}) {
  Octets out;
  put_be16(out, who.source_port);
  put_be16(out, who.destination_port);
  put_be16(out, 8 + payload.size());
  put_be16(out, 0);
  append(out, payload);
  return out;
}

/// Which part of a datagram an IP packet carries; the default is all of it.
struct FragmentPlace {
  std::uint16_t id = 0;
  std::size_t offset = 0;  ///< bytes, a multiple of 8
  bool more = false;
};

/// IPv4 header (checksum 0) with `options` (a multiple of 4 bytes) and body.
inline Octets ipv4(OctetView body,
                   const Endpoints& who = {},
                   const FragmentPlace& place = {},
                   OctetView options = {},
                   std::uint8_t protocol = 17) {
  const std::size_t header = 20 + options.size();
  Octets out{static_cast<std::uint8_t>(0x40 + header / 4), 0};
  put_be16(out, header + body.size());
  put_be16(out, place.id);
  put_be16(out, (place.more ? 0x2000U : 0U) + place.offset / 8);
  out.insert(out.end(), {128, protocol, 0, 0});
  put_be32(out, who.source_ipv4);
  put_be32(out, who.destination_ipv4);
  append(out, options);
  append(out, body);
  return out;
}

inline Octets ethernet(OctetView body, std::uint16_t ethertype = 0x0800) {
  Octets out{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0x60, 0x76, 0x88, 0x00, 0x00, 0x00};
  put_be16(out, ethertype);
  append(out, body);
  return out;
}

/// The frame in which a sensor sends `payload`.
inline Octets udp_frame(OctetView payload, const Endpoints& who = {}) {
  return ethernet(ipv4(udp(payload, who), who));
}

/// Writes a classic pcap file in this machine's byte order. A record is on disk when the writer is destroyed
/// or flushed.
class PcapWriter {
 public:
  enum class Stamps { kMicroseconds, kNanoseconds };

  explicit PcapWriter(const std::filesystem::path& file,
                      Stamps stamps = Stamps::kNanoseconds,
                      std::uint32_t link_type = 1,
                      std::uint32_t snap_length = 65535)
      : out_(file, std::ios::binary), stamps_(stamps), snap_length_(snap_length) {
    out_.exceptions(std::ios::failbit | std::ios::badbit);
    put(stamps == Stamps::kNanoseconds ? 0xA1B23C4DU : 0xA1B2C3D4U);
    put(std::uint16_t{2});
    put(std::uint16_t{4});
    put(std::uint64_t{0});  // time zone, accuracy: always zero
    put(snap_length);
    put(link_type);
  }

  /// Stores at most the snap length of `frame`; `sent_bytes` overrides the length it claims to have had.
  void write(OctetView frame, std::int64_t stamp_ns, std::size_t sent_bytes = 0) {
    const std::size_t kept = frame.size() < snap_length_ ? frame.size() : snap_length_;
    const std::int64_t fraction = stamp_ns % 1'000'000'000;
    put(static_cast<std::uint32_t>(stamp_ns / 1'000'000'000));
    put(static_cast<std::uint32_t>(stamps_ == Stamps::kNanoseconds ? fraction : fraction / 1000));
    put(static_cast<std::uint32_t>(kept));
    put(static_cast<std::uint32_t>(sent_bytes == 0 ? frame.size() : sent_bytes));
    out_.write(reinterpret_cast<const char*>(frame.data()), static_cast<std::streamsize>(kept));
  }
  void write_udp(OctetView payload, std::int64_t stamp_ns, const Endpoints& who = {}) {
    write(udp_frame(payload, who), stamp_ns);
  }
  void flush() { out_.flush(); }

 private:
  template <typename T>
  void put(T value) {
    out_.write(reinterpret_cast<const char*>(&value), sizeof value);
  }

  std::ofstream out_;
  Stamps stamps_;
  std::uint32_t snap_length_;
};

}  // namespace pago::test
