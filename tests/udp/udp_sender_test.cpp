// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/udp/udp_sender.hpp"

#include <vector>

#include "pago/core/error.hpp"
#include "support/catch.hpp"

using namespace pago;

TEST_CASE("what is sent in batches arrives in order", "[udp][udp_sender]") {
  UdpSource source({"127.0.0.1", 0});
  UdpSender sender({"", source.port()});
  std::vector<std::vector<std::uint8_t>> payloads;
  std::vector<Datagram> batch;
  for (std::uint8_t i = 0; i < 100; ++i) payloads.push_back(std::vector<std::uint8_t>(10U + i, i));
  for (const auto& payload : payloads) batch.push_back({.payload = payload});
  sender.send(std::span(batch).first(60));
  sender.send(std::span(batch).subspan(60));
  CHECK(sender.sent() == 100);
  CHECK(sender.unsent() == 0);
  std::size_t got = 0;
  for (int drains = 0; drains < 500 && got < 100; ++drains)
    for (const Datagram& datagram : source.receive()) {
      CHECK(std::vector<std::uint8_t>(datagram.payload.begin(), datagram.payload.end()) == payloads[got]);
      ++got;
    }
  CHECK(got == 100);
}

TEST_CASE("what the kernel refuses is counted, the rest is sent", "[udp][udp_sender]") {
  UdpSource source({"127.0.0.1", 0});
  UdpSender sender({"127.0.0.1", source.port()});
  const std::vector<std::uint8_t> fine(100, 1), too_long(70'000, 2);
  const std::vector<Datagram> batch{{.payload = fine}, {.payload = too_long}, {.payload = fine}};
  sender.send(batch);
  CHECK(sender.sent() == 2);
  CHECK(sender.unsent() == 1);
}

TEST_CASE("a destination without a port or with a name is refused", "[udp][udp_sender]") {
  CHECK_THROWS_AS(UdpSender({"127.0.0.1", 0}), Error);
  CHECK_THROWS_AS(UdpSender({"localhost", 2368}), Error);
}
