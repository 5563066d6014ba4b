// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Captures: refused by Error, or datagrams whose fates add up.
#include "fuzz/fuzz.hpp"
#include "pago/core/error.hpp"
#include "pago/pcap/pcap_source.hpp"

using namespace pago;

namespace {

void read(const std::filesystem::path& file) {
  PcapSource source(file, {.port = 0, .source_address = {}});
  std::uint64_t delivered = 0;
  std::size_t sum = 0;
  while (!source.all_done()) {
    for (const Datagram& datagram : source.receive()) {
      ++delivered;
      for (const std::uint8_t byte : datagram.payload) sum += byte;  // all of it is there
    }
  }
  fuzz::require(sum <= 255 * PcapSource::kMaxPayloadBytes * delivered);
  fuzz::require(source.counters().balanced());
  fuzz::require(source.counters().delivered == delivered);
  fuzz::require(source.complaint().size() < 10'000);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static fuzz::MemoryFile file;
  try {
    read(file.hold({data, size}));
  } catch (const Error&) {
  }
  return 0;
}
