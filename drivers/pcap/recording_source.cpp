// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/recording_source.hpp"

namespace pago {

std::span<const Datagram> RecordingSource::receive() noexcept {
  const std::span<const Datagram> batch = source_.receive();
  for (const Datagram& datagram : batch) recorder_.add(datagram);
  return batch;
}

}  // namespace pago
