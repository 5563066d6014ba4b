// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Captured records without a file around them: headers taken apart, fragments put together. The input is the
// link layer, then records, each behind its length and how far it lies from the last one in time.
#include <algorithm>

#include "drivers/pcap/fragments.hpp"
#include "drivers/pcap/frame.hpp"
#include "fuzz/fuzz.hpp"

using namespace pago;

namespace {

constexpr std::size_t kMostBytes = 2'056;  // of a datagram, header included
constexpr std::int64_t kStep_ns = 10'000'000;

pcap::LinkType link_of(std::uint8_t byte) {
  constexpr std::array kLinks{pcap::LinkType::kEthernet, pcap::LinkType::kLinuxCooked,
                              pcap::LinkType::kLinuxCooked2, pcap::LinkType::kRawIp,
                              pcap::LinkType::kLoopback};
  return kLinks[byte % kLinks.size()];
}

bool lies_within(pcap::Bytes part, pcap::Bytes whole) {
  return part.empty() ||
         (part.data() >= whole.data() && part.data() + part.size() <= whole.data() + whole.size());
}

/// How many of the datagrams that began came to their end.
std::uint64_t ended(const SourceCounters& counters) {
  return counters.truncated + counters.malformed + counters.fragment_lost;
}

void put_together(pcap::FragmentTable& table,
                  const pcap::Frame& piece,
                  std::int64_t stamp_ns,
                  SourceCounters& counters) {
  const pcap::Bytes datagram = table.add(piece, stamp_ns, counters);
  fuzz::require(datagram.size() <= kMostBytes && counters.received == ended(counters));
  pcap::Frame whole;
  if (!datagram.empty()) pcap::parse_udp(datagram, datagram.size(), whole);
  fuzz::require(lies_within(whole.payload, datagram));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static pcap::FragmentTable table(kMostBytes);
  SourceCounters counters;
  std::int64_t stamp_ns = 0;
  for (std::size_t at = 1; at + 2 <= size;) {
    const std::size_t length = std::min<std::size_t>(data[at], size - at - 2);
    stamp_ns += kStep_ns * data[at + 1];
    const pcap::Bytes record(data + at + 2, length);
    const pcap::Frame frame = pcap::parse_frame(link_of(data[0]), record);
    fuzz::require(lies_within(frame.payload, record));
    if (frame.kind == pcap::Frame::Kind::kFragment) put_together(table, frame, stamp_ns, counters);
    at += 2 + length;
  }
  table.finish(counters);
  fuzz::require(counters.received == ended(counters));
  return 0;
}
