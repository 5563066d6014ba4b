// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/pcap_source.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "capture_file.hpp"
#include "fragments.hpp"
#include "frame.hpp"
#include "pago/config/packet_filter.hpp"

namespace pago {
namespace {

/// Records looked at in one receive(), so that a capture of other traffic does not keep the thread.
constexpr int kMaxRecordsPerCall = 4096;
constexpr std::size_t kUdpHeaderBytes = 8;

/// Which part of a capture is used, by its own stamps.
class Window {
 public:
  explicit Window(const CaptureConfig& part) : start_s_(part.start_s), duration_s_(part.duration_s) {}

  bool is_inside(std::int64_t stamp_ns) noexcept {
    if (!has_begun_) first_ns_ = stamp_ns;
    has_begun_ = true;
    // Damaged files hold any stamps: as doubles their differences cannot overflow.
    elapsed_s_ = (static_cast<double>(stamp_ns) - static_cast<double>(first_ns_)) * 1e-9 - start_s_;
    const bool is_beyond = duration_s_ > 0.0 && elapsed_s_ >= duration_s_;
    beyond_ = is_beyond ? beyond_ + 1 : 0;
    return elapsed_s_ >= 0.0 && !is_beyond;
  }
  /// One record from beyond may be a damaged stamp.
  bool is_over() const noexcept { return beyond_ >= kBeyond; }
  std::optional<Progress> progress() const noexcept {
    if (duration_s_ == 0.0) return std::nullopt;
    return Progress{is_over() ? duration_s_ : std::clamp(elapsed_s_, 0.0, duration_s_), duration_s_};
  }

 private:
  static constexpr int kBeyond = 16;

  double start_s_, duration_s_, elapsed_s_ = 0.0;
  std::int64_t first_ns_ = 0;
  bool has_begun_ = false;
  int beyond_ = 0;
};

}  // namespace

struct PcapSource::State {
  State(const std::filesystem::path& file, const PacketFilterConfig& filter_config, const CaptureConfig& part)
      : filter(PacketFilter::of(filter_config)),
        window(part),
        capture(file),
        fragments(kMaxPayloadBytes + kUdpHeaderBytes),
        bytes(kBatch * kMaxPayloadBytes) {}

  void take(const pcap::Record& record) noexcept;
  void take_piece(const pcap::Record& record, const pcap::Frame& piece) noexcept;
  void take_udp(const pcap::Frame& frame, std::int64_t stamp_ns) noexcept;
  void deliver(const pcap::Frame& frame, std::int64_t stamp_ns) noexcept;
  void end() noexcept;

  bool is_wanted_sender(const pcap::Frame& frame) const noexcept {
    return filter.takes_sender(frame.source_ipv4);
  }
  bool is_wanted(const pcap::Frame& frame) const noexcept {
    return filter.takes(frame.source_ipv4, frame.destination_port);
  }
  void count(std::uint64_t SourceCounters::*fate) noexcept {
    ++counters.received;
    ++(counters.*fate);
  }

  PacketFilter filter;
  Window window;
  pcap::CaptureFile capture;
  pcap::FragmentTable fragments;
  AlignedArray<std::uint8_t> bytes;  // kBatch payloads
  std::array<Datagram, kBatch> batch{};
  std::size_t batch_size = 0;
  bool has_ended = false;
  SourceCounters counters;
};

void PcapSource::State::take(const pcap::Record& record) noexcept {
  using Kind = pcap::Frame::Kind;
  const pcap::Frame frame = pcap::parse_frame(capture.link(), record.bytes);
  switch (frame.kind) {
    case Kind::kUdp:
      return take_udp(frame, record.stamp_ns);
    case Kind::kFragment:
      return take_piece(record, frame);
    case Kind::kOther:
      if (frame.fragment_offset == 0) count(&SourceCounters::filtered);
      return;
    case Kind::kMalformed:
      return count(&SourceCounters::malformed);
    case Kind::kShort:
      // Headers that got through and name another port or sender settle it; zero means not reached.
      if ((frame.source_ipv4 != 0 && !is_wanted_sender(frame)) ||
          (frame.destination_port != 0 && !is_wanted(frame)))
        return count(&SourceCounters::filtered);
      return count(record.is_cut ? &SourceCounters::truncated : &SourceCounters::malformed);
  }
}

void PcapSource::State::take_piece(const pcap::Record& record, const pcap::Frame& piece) noexcept {
  if (!is_wanted_sender(piece)) {
    if (piece.fragment_offset == 0) count(&SourceCounters::filtered);
    return;
  }
  if (piece.payload.size() < piece.fragment_length && !record.is_cut)
    return count(&SourceCounters::malformed);
  const pcap::Bytes datagram = fragments.add(piece, record.stamp_ns, counters);
  if (datagram.empty()) return;
  pcap::Frame whole;
  whole.source_ipv4 = piece.source_ipv4;
  pcap::parse_udp(datagram, datagram.size(), whole);
  if (whole.kind != pcap::Frame::Kind::kUdp) return count(&SourceCounters::malformed);
  take_udp(whole, record.stamp_ns);
}

void PcapSource::State::take_udp(const pcap::Frame& frame, std::int64_t stamp_ns) noexcept {
  if (!is_wanted(frame)) return count(&SourceCounters::filtered);
  if (frame.payload.size() > kMaxPayloadBytes) return count(&SourceCounters::truncated);
  deliver(frame, stamp_ns);
}

void PcapSource::State::deliver(const pcap::Frame& frame, std::int64_t stamp_ns) noexcept {
  std::uint8_t* const to = bytes.data() + batch_size * kMaxPayloadBytes;
  std::copy(frame.payload.begin(), frame.payload.end(), to);
  batch[batch_size++] = {.payload = {to, frame.payload.size()},
                         .arrival_ns = stamp_ns,
                         .source_ipv4 = frame.source_ipv4,
                         .source_port = frame.source_port,
                         .destination_port = frame.destination_port};
  count(&SourceCounters::delivered);
}

void PcapSource::State::end() noexcept {
  has_ended = true;
  if (capture.ends_inside_record()) count(&SourceCounters::truncated);
  fragments.finish(counters);
}

PcapSource::PcapSource(const std::filesystem::path& file,
                       const PacketFilterConfig& filter,
                       const CaptureConfig& part)
    : state_(std::make_unique<State>(file, filter, part)) {}

PcapSource::~PcapSource() = default;

std::span<const Datagram> PcapSource::receive() noexcept {
  State& state = *state_;
  state.batch_size = 0;
  for (int i = 0; i < kMaxRecordsPerCall && state.batch_size < kBatch && !state.has_ended; ++i) {
    const std::optional<pcap::Record> record = state.capture.next();
    if (!record || state.window.is_over())
      state.end();
    else if (state.window.is_inside(record->stamp_ns))
      state.take(*record);
  }
  return {state.batch.data(), state.batch_size};
}

bool PcapSource::all_done() const noexcept {
  return state_->has_ended;
}
SourceCounters PcapSource::counters() const noexcept {
  return state_->counters;
}
Progress PcapSource::progress() const noexcept {
  return state_->window.progress().value_or(state_->capture.progress());
}
std::string PcapSource::complaint() const {
  return state_->capture.complaint();
}

}  // namespace pago
