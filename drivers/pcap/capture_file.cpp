// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "capture_file.hpp"

#include <pcap/pcap.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <limits>

#include "pago/core/error.hpp"

namespace pago::pcap {
namespace {

namespace fs = std::filesystem;

/// Large reads: the default of 4 KiB would cost one system call per three packets.
constexpr std::size_t kBufferBytes = 256 * 1024;

struct CloseStream {
  void operator()(std::FILE* stream) const noexcept { std::fclose(stream); }
};
using Stream = std::unique_ptr<std::FILE, CloseStream>;

Stream open_stream(const fs::path& file) {
  std::error_code ignored;
  if (fs::is_directory(file, ignored))
    throw Error(file.string(), "is a folder, not a capture file",
                "a folder of KITTI scans is given as kitti:FOLDER");
  Stream stream(std::fopen(file.c_str(), "rbe"));
  if (!stream)
    throw Error(file.string(), std::string("cannot be opened: ") + std::strerror(errno),
                "check the path and the permissions");
  return stream;
}

/// Why libpcap may have refused a file, from its first bytes.
std::string hint_for(const fs::path& file) {
  std::array<unsigned char, 4> head{};
  const Stream stream(std::fopen(file.c_str(), "rbe"));
  const std::size_t n = stream ? std::fread(head.data(), 1, head.size(), stream.get()) : 0;
  if (n == 0) return "the file is empty";
  if (head[0] == 0x1F && head[1] == 0x8B) return "it is compressed: unpack it with gunzip first";
  if (head[0] == 0xFD && head[1] == '7') return "it is compressed: unpack it with unxz first";
  if (head[0] == 0x28 && head[1] == 0xB5) return "it is compressed: unpack it with unzstd first";
  return "PaGO reads pcap and pcapng, as written by tcpdump, Wireshark or VeloView";
}

LinkType checked_link(::pcap* handle, const fs::path& file) {
  const int dlt = pcap_datalink(handle);
  if (const auto link = link_type(dlt)) return *link;
  const char* const name = pcap_datalink_val_to_name(dlt);
  throw Error(file.string(),
              "was captured on a link layer that is not supported: " +
                  (name ? std::string(name) : std::to_string(dlt)),
              "capture on Ethernet, on 'any' or on a raw IP interface");
}

std::int64_t to_stamp_ns(const timeval& stamp) noexcept {
  // With nanosecond precision libpcap puts nanoseconds into tv_usec. Damaged files hold any seconds.
  constexpr std::int64_t kNsPerS = 1'000'000'000;
  constexpr std::int64_t kMaxS = std::numeric_limits<std::int64_t>::max() / kNsPerS - 10;
  const std::int64_t seconds = std::clamp<std::int64_t>(stamp.tv_sec, -kMaxS, kMaxS);
  return seconds * kNsPerS + std::clamp<std::int64_t>(stamp.tv_usec, 0, 8 * kNsPerS);
}

}  // namespace

void CaptureFile::Close::operator()(::pcap* handle) const noexcept {
  pcap_close(handle);
}

CaptureFile::CaptureFile(const fs::path& file) : path_(file), buffer_(kBufferBytes) {
  Stream stream = open_stream(file);
  std::setvbuf(stream.get(), buffer_.data(), _IOFBF, buffer_.size());
  std::array<char, PCAP_ERRBUF_SIZE> message{};
  handle_.reset(
      pcap_fopen_offline_with_tstamp_precision(stream.get(), PCAP_TSTAMP_PRECISION_NANO, message.data()));
  if (!handle_)
    throw Error(file.string(), std::string("is not a capture: ") + message.data(), hint_for(file));
  stream_ = stream.release();
  link_ = checked_link(handle_.get(), file);
  std::error_code not_a_file;
  const auto size = fs::file_size(file, not_a_file);
  size_bytes_ = not_a_file ? 0.0 : static_cast<double>(size);
}

std::optional<Record> CaptureFile::next() noexcept {
  if (has_ended_) return std::nullopt;
  record_at_byte_ = std::max<std::int64_t>(0, ftello(stream_));
  pcap_pkthdr* header = nullptr;
  const unsigned char* bytes = nullptr;
  const int got = pcap_next_ex(handle_.get(), &header, &bytes);
  if (got != 1) {
    has_ended_ = true;
    if (got != PCAP_ERROR_BREAK) fault_ = std::feof(stream_) ? Fault::kEndsInside : Fault::kDamaged;
    return std::nullopt;
  }
  ++records_;
  return Record{.bytes = {bytes, header->caplen},
                .stamp_ns = to_stamp_ns(header->ts),
                .is_cut = header->caplen < header->len};
}

Progress CaptureFile::progress() const noexcept {
  const bool is_complete = has_ended_ && fault_ == Fault::kNone;
  return {is_complete ? size_bytes_ : static_cast<double>(record_at_byte_), size_bytes_};
}

std::string CaptureFile::complaint() const {
  if (fault_ == Fault::kNone) return {};
  const std::string at = std::to_string(record_at_byte_);
  const std::string kept = "; the " + std::to_string(records_) + " records before it were used";
  if (fault_ == Fault::kEndsInside)
    return path_.string() + ": the capture ends inside a record at byte " + at + kept;
  return path_.string() + ": damaged at byte " + at + " (" + pcap_geterr(handle_.get()) + ")" + kept +
         ", nothing after it";
}

}  // namespace pago::pcap
