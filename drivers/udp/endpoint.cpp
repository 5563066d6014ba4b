// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <charconv>

#include "pago/core/error.hpp"
#include "pago/udp/udp_source.hpp"

namespace pago {

UdpEndpoint parse_udp_endpoint(const std::string& text) {
  constexpr std::string_view kPrefix = "udp://";
  constexpr auto kForm = "write udp://:2368, or udp://192.168.3.1:2368 for one interface";
  std::string rest = text.starts_with(kPrefix) ? text.substr(kPrefix.size()) : text;
  if (rest.ends_with('/')) rest.pop_back();
  UdpEndpoint endpoint;
  const std::size_t colon = rest.find(':');
  endpoint.address = rest.substr(0, colon);
  if (colon == std::string::npos) return endpoint;
  const std::string port = rest.substr(colon + 1);
  const char* const end = port.data() + port.size();
  const auto [stop, fault] = std::from_chars(port.data(), end, endpoint.port);
  if (fault != std::errc{} || stop != end || endpoint.port < 0 || endpoint.port > 65535)
    throw Error(text, "'" + port + "' is no UDP port", kForm);
  return endpoint;
}

std::string to_string(const UdpEndpoint& endpoint) {
  return "udp://" + endpoint.address + ":" + std::to_string(endpoint.port);
}

}  // namespace pago
