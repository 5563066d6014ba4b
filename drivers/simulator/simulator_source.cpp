// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/simulator_source.hpp"

#include <exception>

#include "pago/pcap/pcap_writer.hpp"
#include "timing.hpp"

namespace pago {

SimulatorSource::SimulatorSource(const SimulatorConfig& config, const Hdl64Config& sensor, const Mount& mount)
    : simulator_(config, sensor, mount),
      labels_(kRemembered, simulator::kSingleReturn.period_ns, simulator::kSingleReturn.firings) {}

std::span<const Datagram> SimulatorSource::receive() noexcept {
  const UdpEndpoints sender;
  std::size_t n = 0;
  try {
    while (n < kBatch && !has_ended_) {
      has_ended_ = !simulator_.next(packets_[n]);
      if (!has_ended_) ++n;
    }
  } catch (const std::exception& error) {
    has_ended_ = true;
    complaint_ = std::string("simulator: ") + error.what();
  }
  for (std::size_t i = 0; i < n; ++i) {
    labels_.add(packets_[i]);
    datagrams_[i] = {.payload = packets_[i].bytes,
                     .arrival_ns = packets_[i].arrival_ns,
                     .source_ipv4 = sender.source_ipv4,
                     .source_port = sender.source_port,
                     .destination_port = sender.destination_port};
  }
  counters_.received += n;
  counters_.delivered += n;
  return {datagrams_.data(), n};
}

Progress SimulatorSource::progress() const noexcept {
  return {static_cast<double>(counters_.delivered), static_cast<double>(simulator_.num_packets())};
}

}  // namespace pago
