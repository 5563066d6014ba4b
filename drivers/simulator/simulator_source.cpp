// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/simulator_source.hpp"

#include <exception>

#include "faults.hpp"
#include "pago/pcap/pcap_writer.hpp"

namespace pago {

struct SimulatorSource::Arrivals {
  simulator::FaultyWay way;
  std::vector<simulator::SentPacket> packets;
};

SimulatorSource::SimulatorSource(const SimulatorConfig& config, const Hdl64Config& sensor, const Mount& mount)
    : simulator_(config, sensor, mount),
      labels_(kRemembered, simulator_.format().firing_period_ns, simulator_.format().firings()),
      arrivals_(std::make_unique<Arrivals>(
          Arrivals{{config.faults, simulator_.start_ns(), static_cast<std::uint64_t>(config.seed)}, {}})) {
  arrivals_->packets.reserve(kBatch * simulator::FaultyWay::kMost);
  datagrams_.reserve(arrivals_->packets.capacity());
}

SimulatorSource::~SimulatorSource() = default;

std::span<const Datagram> SimulatorSource::receive() noexcept {
  const UdpEndpoints sender;
  arrivals_->packets.clear();
  datagrams_.clear();
  try {
    // While nothing arrives, time goes on.
    for (std::size_t n = 0; (n < kBatch || arrivals_->packets.empty()) && !has_ended_; ++n) {
      has_ended_ = !simulator_.next(packet_);
      if (has_ended_) {
        arrivals_->way.finish(arrivals_->packets);
        break;
      }
      ++packets_done_;
      labels_.add(packet_);
      arrivals_->way.pass(packet_, arrivals_->packets);
    }
  } catch (const std::exception& error) {
    has_ended_ = true;
    complaint_ = std::string("simulator: ") + error.what();
  }
  for (const simulator::SentPacket& packet : arrivals_->packets) {
    datagrams_.push_back({.payload = packet.payload(),
                          .arrival_ns = packet.arrival_ns,
                          .source_ipv4 = sender.source_ipv4,
                          .source_port = sender.source_port,
                          .destination_port = sender.destination_port});
  }
  counters_.received += datagrams_.size();
  counters_.delivered += datagrams_.size();
  return datagrams_;
}

Progress SimulatorSource::progress() const noexcept {
  return {static_cast<double>(packets_done_), static_cast<double>(simulator_.num_packets())};
}

}  // namespace pago
