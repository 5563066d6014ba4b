// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/assembly/stream_survey.hpp"

#include <algorithm>

namespace pago {

/// Has no sweeps: packets are looked at and given up.
class StreamSurvey::Nowhere final : public SweepExchange {
 public:
  Sweep* acquire() noexcept override { return nullptr; }
  void hand_on(const SweepPart&) noexcept override {}
};

StreamSurvey::StreamSurvey(const Hdl64Config& sensor, const std::optional<hdl64::Calibration>& calibration)
    : config_(sensor),
      nowhere_(std::make_unique<Nowhere>()),
      ingest_(std::make_unique<PacketIngest>(
          AssemblyConfig{}, sensor, calibration.value_or(hdl64::Calibration{}), *nowhere_)) {
  if (calibration) compared_with_ = calibration->origin;
}

StreamSurvey::~StreamSurvey() = default;

void StreamSurvey::add(const Datagram& datagram) {
  note_sender(datagram);
  ingest_->push(datagram);
}

void StreamSurvey::note_sender(const Datagram& datagram) {
  const std::uint64_t key = std::uint64_t{datagram.source_ipv4} << 32U |
                            std::uint64_t{datagram.source_port} << 16U | datagram.destination_port;
  Seen& seen = seen_[key];
  seen.sender.ipv4 = datagram.source_ipv4;
  seen.sender.port = datagram.source_port;
  seen.sender.destination_port = datagram.destination_port;
  ++seen.sender.datagrams;
  seen.sender.packets += datagram.payload.size() == hdl64::kPacketBytes ? 1U : 0U;
  seen.probe.add(datagram.payload, datagram.arrival_ns);
}

void StreamSurvey::finish() {
  ingest_->finish();
}

const PacketIngest& StreamSurvey::ingest() const noexcept {
  return *ingest_;
}

std::vector<Sender> StreamSurvey::senders() const {
  std::vector<Sender> result;
  for (const auto& [key, seen] : seen_) {
    result.push_back(seen.sender);
    result.back().sensor = seen.probe.kind();
  }
  std::stable_sort(result.begin(), result.end(),
                   [](const Sender& a, const Sender& b) { return a.datagrams > b.datagrams; });
  return result;
}

std::optional<hdl64::Calibration> StreamSurvey::calibration() const {
  return ingest_->status().calibration(config_.vertical_offset);
}

std::string StreamSurvey::complaint() const {
  const auto& difference = ingest_->calibration_difference();
  if (!compared_with_ || !difference) return {};
  return hdl64::complaint_about(*difference, *compared_with_);
}

}  // namespace pago
