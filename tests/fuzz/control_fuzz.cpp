// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The control socket: whatever a client sends, in whatever pieces, it gets lines of JSON or is hung up on.
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstring>

#include "fuzz/fuzz.hpp"
#include "pago/output/control.hpp"

using namespace pago;

namespace {

/// Connected to the server, without blocking.
int connect_to(const std::string& path) {
  const int client = socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  fuzz::require(connect(client, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  return client;
}

void read_answers(int client) {
  std::array<char, 65536> text{};
  const ssize_t size = recv(client, text.data(), text.size(), MSG_DONTWAIT);
  for (ssize_t i = 0; i < size; ++i) {
    const bool begins = i == 0 || text[static_cast<std::size_t>(i - 1)] == '\n';
    fuzz::require(!begins || text[static_cast<std::size_t>(i)] == '{');
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static output::ControlServer server("/tmp/pago_fuzz." + std::to_string(getpid()) + ".ctl");
  const auto handle = [](output::Request) { return std::string(R"({"ok": true})"); };
  const int client = connect_to(server.path());
  // The first byte says in what pieces.
  const std::size_t piece = size > 0 ? 1U + data[0] : 1U;
  for (std::size_t at = 1; at < size; at += piece) {
    const std::size_t length = std::min(piece, size - at);
    if (send(client, data + at, length, MSG_DONTWAIT | MSG_NOSIGNAL) < 0) break;
    server.serve(handle);
    read_answers(client);
  }
  close(client);
  server.serve(handle);
  return 0;
}
