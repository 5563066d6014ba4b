// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "frame.hpp"
#include "pago/core/aligned_array.hpp"
#include "pago/core/sources.hpp"

struct pcap;  // libpcap's pcap_t

namespace pago::pcap {

/// One record of a capture. `bytes` stay valid until the next one is read.
struct Record {
  Bytes bytes;
  std::int64_t stamp_ns = 0;  ///< since the Unix epoch
  bool is_cut = false;        ///< sent longer than recorded
};

/// A capture file read through libpcap, which knows the containers. [set-up] the constructor; [ingest thread]
/// the rest.
class CaptureFile {
 public:
  /// Throws Error: cannot be read, no capture, or a link layer that carries no IP.
  explicit CaptureFile(const std::filesystem::path& file);

  /// Nothing at the end, and ever after; then complaint() tells if it came early.
  std::optional<Record> next() noexcept;

  LinkType link() const noexcept { return link_; }
  bool ends_inside_record() const noexcept { return fault_ == Fault::kEndsInside; }
  Progress progress() const noexcept;
  std::string complaint() const;

 private:
  enum class Fault : std::uint8_t { kNone, kEndsInside, kDamaged };
  struct Close {
    void operator()(::pcap* handle) const noexcept;
  };

  std::filesystem::path path_;
  AlignedArray<char> buffer_;  // stdio's; must outlive handle_, which closes the stream
  std::unique_ptr<::pcap, Close> handle_;
  std::FILE* stream_ = nullptr;  // owned by handle_
  LinkType link_ = LinkType::kEthernet;
  double size_bytes_ = 0.0;
  std::int64_t record_at_byte_ = 0;
  std::uint64_t records_ = 0;
  Fault fault_ = Fault::kNone;
  bool has_ended_ = false;
};

}  // namespace pago::pcap
