// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/pcap_writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "pago/core/error.hpp"

namespace pago {
namespace {

constexpr std::size_t kRecordHeader = 16, kEthernet = 14, kIp = 20, kUdp = 8;
constexpr std::size_t kHeaders = kEthernet + kIp + kUdp;
constexpr std::size_t kHeldRecords = 64;
constexpr std::size_t kMaxRecord = kRecordHeader + kHeaders + PcapWriter::kMaxPayloadBytes;

std::string reason(int number) {
  return std::generic_category().message(number);
}

/// Appends numbers to a buffer; the network's order is the most significant byte first.
class Pen {
 public:
  explicit Pen(std::uint8_t* to) : to_(to) {}

  template <typename T>
  Pen& native(T value) {
    std::memcpy(to_, &value, sizeof value);
    to_ += sizeof value;
    return *this;
  }
  Pen& network16(std::size_t value) {
    *to_++ = static_cast<std::uint8_t>(value >> 8U & 0xFFU);
    *to_++ = static_cast<std::uint8_t>(value & 0xFFU);
    return *this;
  }
  Pen& network32(std::uint32_t value) { return network16(value >> 16U).network16(value & 0xFFFFU); }
  Pen& bytes(std::span<const std::uint8_t> from) {
    std::memcpy(to_, from.data(), from.size());
    to_ += from.size();
    return *this;
  }

 private:
  std::uint8_t* to_;
};

/// RFC 1071 over an IPv4 header whose checksum field is still zero.
std::uint16_t checksum(const std::uint8_t* header) {
  std::uint32_t sum = 0;
  for (std::size_t i = 0; i < kIp; i += 2) sum += (std::uint32_t{header[i]} << 8U) + header[i + 1];
  while (sum > 0xFFFFU) sum = (sum & 0xFFFFU) + (sum >> 16U);
  return static_cast<std::uint16_t>(~sum);
}

void write_frame(std::uint8_t* to, std::span<const std::uint8_t> payload, const UdpEndpoints& who) {
  constexpr std::array<std::uint8_t, 12> kAddresses{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF,   // to everybody
                                                    0x60, 0x76, 0x88, 0x00, 0x00, 0x00};  // Velodyne's prefix
  constexpr std::uint8_t kVersionAndLength = 0x45, kTimeToLive = 64, kUdpProtocol = 17;
  const std::size_t udp = kUdp + payload.size();
  Pen(to).bytes(kAddresses).network16(0x0800);
  std::uint8_t* const ip = to + kEthernet;
  Pen(ip)
      .native(kVersionAndLength)
      .native(std::uint8_t{0})
      .network16(kIp + udp)
      .network32(0x00004000)  // no identification: never in fragments
      .native(kTimeToLive)
      .native(kUdpProtocol)
      .network16(0)
      .network32(who.source_ipv4)
      .network32(who.destination_ipv4);
  Pen(ip + 10).network16(checksum(ip));
  // UDP's own checksum stays 0, as the sensor sends it.
  Pen(ip + kIp)
      .network16(who.source_port)
      .network16(who.destination_port)
      .network16(udp)
      .network16(0)
      .bytes(payload);
}

}  // namespace

PcapWriter::PcapWriter(std::filesystem::path file)
    : file_(std::move(file)), held_(kHeldRecords * kMaxRecord) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (descriptor_ < 0)
    throw Error(file_.string(), "cannot be made: " + reason(errno), "is the folder there and writable?");
  constexpr std::uint32_t kNanosecondMagic = 0xA1B23C4D, kSnapLength = 65535, kLinkEthernet = 1;
  constexpr std::uint16_t kMajor = 2, kMinor = 4;
  Pen(held_.data())
      .native(kNanosecondMagic)
      .native(kMajor)
      .native(kMinor)
      .native(std::uint64_t{0})  // time zone, accuracy: always zero
      .native(kSnapLength)
      .native(kLinkEthernet);
  held_size_ = bytes_ = 24;
  flush();
  if (complaint_.empty()) return;
  ::close(descriptor_);
  throw Error(file_.string(), complaint_.substr(file_.string().size() + 2), "is the disk full?");
}

PcapWriter::~PcapWriter() {
  flush();
  ::close(descriptor_);
}

void PcapWriter::write(std::span<const std::uint8_t> payload,
                       std::int64_t arrival_ns,
                       const UdpEndpoints& endpoints) noexcept {
  if (payload.size() > kMaxPayloadBytes)
    complaint_ = file_.string() + ": a payload of " + std::to_string(payload.size()) + " bytes is too long";
  if (!complaint_.empty()) {
    ++lost_;
    return;
  }
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  const auto frame_size = static_cast<std::uint32_t>(kHeaders + payload.size());
  std::uint8_t* const record = held_.data() + held_size_;
  Pen(record)
      .native(static_cast<std::uint32_t>(arrival_ns / kSecond_ns))
      .native(static_cast<std::uint32_t>(arrival_ns % kSecond_ns))
      .native(frame_size)
      .native(frame_size);
  write_frame(record + kRecordHeader, payload, endpoints);
  held_size_ += kRecordHeader + frame_size;
  bytes_ += kRecordHeader + frame_size;
  ++num_held_;
  ++records_;
  if (held_.size() - held_size_ < kMaxRecord) flush();
}

void PcapWriter::flush() noexcept {
  std::size_t done = 0;
  while (done < held_size_) {
    const ssize_t got = ::write(descriptor_, held_.data() + done, held_size_ - done);
    if (got > 0) done += static_cast<std::size_t>(got);
    if (got < 0 && errno != EINTR) return lose_held("cannot be written: " + reason(errno));
  }
  held_size_ = num_held_ = 0;
}

void PcapWriter::lose_held(const std::string& why) noexcept {
  bytes_ -= held_size_;
  records_ -= num_held_;
  lost_ += num_held_;
  held_size_ = num_held_ = 0;
  const auto end = static_cast<off_t>(bytes_);
  if (complaint_.empty()) complaint_ = file_.string() + ": " + why;
  if (::ftruncate(descriptor_, end) != 0 || ::lseek(descriptor_, end, SEEK_SET) != end)
    complaint_ += "; it may end inside a record";
}

}  // namespace pago
