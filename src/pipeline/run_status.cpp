// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/run_status.hpp"

#include <array>

#include "pago/config/packet_filter.hpp"
#include "pago/core/text.hpp"

namespace pago {

namespace {

constexpr std::int64_t kSilence_ns = 300'000'000;

unsigned long long number(std::uint64_t n) {
  return n;
}

}  // namespace

std::string_view to_string(StreamState state) noexcept {
  constexpr std::array<std::string_view, static_cast<std::size_t>(StreamState::kCount)> kWords{
      "no data", "foreign data", "other sensor", "silent", "not spinning", "running"};
  return kWords[static_cast<std::size_t>(state)];
}

StreamState stream_state(const IngestStatus& status, std::int64_t now_monotonic_ns) noexcept {
  if (status.source.delivered == 0)
    return status.source.received == 0 ? StreamState::kNoData : StreamState::kForeign;
  const bool is_all_damaged =
      status.packets.received > 0 && status.packets.bad_total() == status.packets.received;
  if (is_all_damaged && !status.is_refused) return StreamState::kForeign;
  if (now_monotonic_ns - status.last_delivery_ns > kSilence_ns) return StreamState::kSilent;
  if (status.is_refused) return StreamState::kOtherSensor;
  // Until the first packets have told how the head turns it is not known to stand.
  if (status.packets.decoded > 0 && status.rotation_hz == 0.0) return StreamState::kNotSpinning;
  return StreamState::kRunning;
}

std::string explain(StreamState state, const IngestStatus& status, const std::string& source) {
  switch (state) {
    case StreamState::kNoData:
      return "no data on " + source +
             " yet: is the sensor on and cabled, this host's address in its network (192.168.3.x/24 as "
             "delivered), and no firewall or reverse-path filter (net.ipv4.conf.*.rp_filter) in the way? A "
             "sensor that broadcasts is not heard by udp://ADDRESS:PORT, only by udp://:PORT. `tcpdump -i "
             "any "
             "udp` shows what arrives";
    case StreamState::kForeign:
      return format("%llu datagrams on ", number(status.source.received)) + source +
             format(
                 ", none of an HDL-64E: %llu from another sender (packets.source_address), %llu of another "
                 "size or damaged",
                 number(status.source.filtered),
                 number(status.source.truncated + status.packets.bad_total()));
    case StreamState::kOtherSensor: {
      const std::string what = hdl64::refusal(status.sensor);
      return "on " + source + ": " +
             (what.empty() ? "no HDL-64E that sends there can be told from what arrives" : what);
    }
    case StreamState::kSilent:
      return source + " has fallen silent: sensor switched off, or its cable or switch disconnected?";
    case StreamState::kNotSpinning:
      return "the sensor sends, but its head does not turn: starting up, motor stopped, or too little "
             "voltage?";
    case StreamState::kRunning:
      return source + ": " + std::string(hdl64::name(status.sensor)) +
             format(", %.2f revolutions per second", status.rotation_hz) +
             (status.is_view_limited ? ", field of view limited" : "") +
             (status.other_sender == 0 ? ""
                                       : "; packets of another sender, " + ipv4_text(status.other_sender) +
                                             ", are left out (packets.source_address)");
    case StreamState::kCount:
      break;
  }
  return {};
}

}  // namespace pago
