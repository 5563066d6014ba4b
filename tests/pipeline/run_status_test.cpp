// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/run_status.hpp"

#include "support/catch.hpp"

using namespace pago;

namespace {

constexpr std::int64_t kNow_ns = 100'000'000'000;

IngestStatus running() {
  IngestStatus status;
  status.source.received = status.source.delivered = 1000;
  status.packets.received = status.packets.decoded = 1000;
  status.last_delivery_ns = kNow_ns - 1'000'000;
  status.rotation_hz = 10.0;
  status.sensor = hdl64::SensorKind::kHdl64Single;
  return status;
}

std::string sentence(const IngestStatus& status) {
  return explain(stream_state(status, kNow_ns), status, "udp://:2368");
}

}  // namespace

TEST_CASE("a stream that runs is described by sensor and speed", "[pipeline][run_status]") {
  CHECK(stream_state(running(), kNow_ns) == StreamState::kRunning);
  CHECK_THAT(sentence(running()), Catch::Contains("HDL-64E") && Catch::Contains("10.00 revolutions"));
}

TEST_CASE("each thing that keeps a stream from running has its state and its likely cause",
          "[pipeline][run_status]") {
  CHECK(stream_state({}, kNow_ns) == StreamState::kNoData);
  CHECK_THAT(sentence({}), Catch::Contains("no data on udp://:2368") && Catch::Contains("rp_filter"));

  IngestStatus foreign;
  foreign.source.received = foreign.source.filtered = 12;
  CHECK(stream_state(foreign, kNow_ns) == StreamState::kForeign);
  CHECK_THAT(sentence(foreign),
             Catch::Contains("12 from another sender") && Catch::Contains("source_address"));

  IngestStatus damaged;
  damaged.source.received = damaged.source.delivered = damaged.packets.received = 15;
  damaged.packets.bad[static_cast<std::size_t>(PacketFault::kSize)] = 15;
  damaged.last_delivery_ns = kNow_ns - 400'000'000;
  CHECK(stream_state(damaged, kNow_ns) == StreamState::kForeign);
  CHECK_THAT(sentence(damaged), Catch::Contains("15 of another size"));

  IngestStatus silent = running();
  silent.last_delivery_ns = kNow_ns - 400'000'000;
  CHECK(stream_state(silent, kNow_ns) == StreamState::kSilent);
  CHECK_THAT(sentence(silent), Catch::Contains("fallen silent") && Catch::Contains("cable"));

  IngestStatus still = running();
  still.rotation_hz = 0.0;
  CHECK(stream_state(still, kNow_ns) == StreamState::kNotSpinning);
  CHECK_THAT(sentence(still), Catch::Contains("does not turn"));

  IngestStatus other = running();
  other.is_refused = true;
  other.sensor = hdl64::SensorKind::kVlp16;
  CHECK(stream_state(other, kNow_ns) == StreamState::kOtherSensor);
  CHECK_THAT(sentence(other), Catch::Contains("VLP-16"));
}

TEST_CASE("until the first packets are understood the head is not said to stand", "[pipeline][run_status]") {
  IngestStatus first = running();
  first.packets.decoded = 0;
  first.rotation_hz = 0.0;
  CHECK(stream_state(first, kNow_ns) == StreamState::kRunning);
}
