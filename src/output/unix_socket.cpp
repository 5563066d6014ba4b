// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "unix_socket.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "pago/core/error.hpp"

namespace pago::output {

namespace {

sockaddr_un address_of(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.empty() || path.size() >= sizeof address.sun_path)
    throw Error(path, "is no path for a socket", "at most 107 characters");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw Error(path, "cannot listen there: " + std::generic_category().message(error),
              "choose another socket: control.socket");
}

}  // namespace

Descriptor::~Descriptor() {
  if (fd_ >= 0) close(fd_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(fd_, other.fd_);
  return *this;
}

Descriptor connect_to(const std::string& path) {
  const sockaddr_un address = address_of(path);
  Descriptor client(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
    return Descriptor();
  return client;
}

Descriptor listen_at(const std::string& path) {
  const sockaddr_un address = address_of(path);
  if (connect_to(path).is_open())
    throw Error(path, "another running pago listens there",
                "stop it, or choose another socket: control.socket");
  struct stat left {};
  if (lstat(path.c_str(), &left) == 0) {
    if (!S_ISSOCK(left.st_mode))
      throw Error(path, "is a file of another kind", "choose another socket: control.socket");
    unlink(path.c_str());
  }
  Descriptor server(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // Made for nobody else from the first moment on.
  const mode_t mask = umask(0177);
  const int bound = bind(server.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address);
  const int error = errno;
  umask(mask);
  if (bound != 0) fail(path, error);
  if (listen(server.get(), 8) != 0) fail(path, errno);
  return server;
}

}  // namespace pago::output
