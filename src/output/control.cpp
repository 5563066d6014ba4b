// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/control.hpp"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "pago/core/error.hpp"
#include "unix_socket.hpp"

namespace pago::output {

namespace {

constexpr std::size_t kMostClients = 8;
constexpr std::size_t kLongestRequest = 64;
constexpr std::size_t kMostPerCall = 16;  // requests of one client, so that none can keep the thread
constexpr int kAnswerWithin_ms = 10'000;
constexpr std::chrono::seconds kIdleAtMost{10};

constexpr std::array<std::pair<std::string_view, Request>, 4> kRequests{{{"status", Request::kStatus},
                                                                         {"save", Request::kSave},
                                                                         {"reset", Request::kReset},
                                                                         {"trace", Request::kTrace}}};

constexpr std::string_view kUnknown = R"({"error": "unknown request; known: status, save, reset, trace"})";

struct Client {
  Descriptor socket;
  std::string unread;
  std::chrono::steady_clock::time_point last_heard = std::chrono::steady_clock::now();
  bool is_over = false;
};

/// Takes in what has come; nothing to take is no end.
void receive(Client& client) {
  std::array<char, 256> bytes{};
  const ssize_t size = recv(client.socket.get(), bytes.data(), bytes.size(), MSG_DONTWAIT);
  const auto now = std::chrono::steady_clock::now();
  if (size > 0) {
    client.unread.append(bytes.data(), static_cast<std::size_t>(size));
    client.last_heard = now;
  } else {
    client.is_over =
        size == 0 || (errno != EAGAIN && errno != EINTR) || now - client.last_heard > kIdleAtMost;
  }
}

std::optional<std::string> next_line(Client& client) {
  const std::size_t end = client.unread.find('\n');
  if (end == std::string::npos) {
    client.is_over = client.is_over || client.unread.size() > kLongestRequest;
    return std::nullopt;
  }
  std::string line = client.unread.substr(0, end);
  client.unread.erase(0, end + 1);
  return line;
}

/// No request ends a run, whatever goes wrong with it.
std::string answer_to(Request request, const std::function<std::string(Request)>& handle) {
  try {
    return handle(request);
  } catch (const std::exception&) {
    return R"({"error": "this cannot be answered now"})";
  }
}

/// A client that does not fetch its answers loses its connection.
void answer(Client& client, std::string text) {
  text += '\n';
  const ssize_t sent = send(client.socket.get(), text.data(), text.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  client.is_over = client.is_over || sent != static_cast<ssize_t>(text.size());
}

}  // namespace

std::optional<Request> parse_request(std::string_view line) noexcept {
  const auto found = std::ranges::find(kRequests, line, &std::pair<std::string_view, Request>::first);
  if (found == kRequests.end()) return std::nullopt;
  return found->second;
}

std::vector<std::string> usual_control_paths() {
  std::vector<std::string> paths;
  if (const char* folder = std::getenv("XDG_RUNTIME_DIR"); folder != nullptr && *folder != '\0')
    paths.push_back(std::string(folder) + "/pago.ctl");
  const uid_t user = getuid();
  if (user == 0) paths.emplace_back("/run/pago.ctl");
  paths.push_back("/tmp/pago." + std::to_string(user) + ".ctl");
  return paths;
}

std::string default_control_path() {
  return usual_control_paths().front();
}

std::string ask_usual(const std::string& line) {
  std::string tried;
  for (const std::string& path : usual_control_paths()) {
    if (connect_to(path).is_open()) return ask(path, line);
    tried += (tried.empty() ? "" : ", ") + path;
  }
  throw Error(tried, "no running pago of this user listens there",
              "is one reading a live sensor? --socket takes its control.socket");
}

struct ControlServer::State {
  std::string path;
  Descriptor listener;
  std::vector<Client> clients;
};

ControlServer::ControlServer(std::string path) : state_(std::make_unique<State>()) {
  state_->listener = listen_at(path);
  state_->path = std::move(path);
}

ControlServer::~ControlServer() {
  unlink(state_->path.c_str());
}

const std::string& ControlServer::path() const noexcept {
  return state_->path;
}

void ControlServer::serve(const std::function<std::string(Request)>& handle) {
  auto& clients = state_->clients;
  while (clients.size() < kMostClients) {
    Descriptor accepted(accept4(state_->listener.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!accepted.is_open()) break;
    Client& client = clients.emplace_back();
    client.socket = std::move(accepted);
  }
  for (Client& client : clients) {
    receive(client);
    for (std::size_t i = 0; i < kMostPerCall; ++i) {
      const auto line = next_line(client);
      if (!line) break;
      const auto request = parse_request(*line);
      answer(client, request ? answer_to(*request, handle) : std::string(kUnknown));
    }
  }
  std::erase_if(clients, [](const Client& client) { return client.is_over; });
}

std::string ask(const std::string& path, const std::string& line) {
  const Descriptor server = connect_to(path);
  if (!server.is_open())
    throw Error(path, "no running pago listens there", "is one reading a live sensor? see control.socket");
  const std::string request = line + "\n";
  send(server.get(), request.data(), request.size(), MSG_NOSIGNAL);
  std::string text;
  std::array<char, 4096> bytes{};
  while (text.find('\n') == std::string::npos) {
    pollfd waiting{.fd = server.get(), .events = POLLIN, .revents = 0};
    if (poll(&waiting, 1, kAnswerWithin_ms) <= 0) throw Error(path, "pago does not answer");
    const ssize_t size = recv(server.get(), bytes.data(), bytes.size(), 0);
    if (size <= 0) throw Error(path, "pago has hung up");
    text.append(bytes.data(), static_cast<std::size_t>(size));
  }
  return text.substr(0, text.find('\n'));
}

}  // namespace pago::output
