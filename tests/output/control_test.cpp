// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/control.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>
#include <vector>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::output;

namespace {

/// A server that is asked by another thread until it goes.
class Serving {
 public:
  explicit Serving(const std::string& path) : server_(path), thread_([this] { serve(); }) {}
  ~Serving() {
    stop_ = true;
    thread_.join();
  }
  std::atomic<int> saves{0};

 private:
  void serve() {
    while (!stop_) {
      server_.serve([this](Request request) {
        if (request == Request::kSave) ++saves;
        return std::string(request == Request::kStatus ? R"({"state": "running"})" : "{}");
      });
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  ControlServer server_;
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

int connect_raw(const std::string& path) {
  const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strcpy(address.sun_path, path.c_str());
  REQUIRE(connect(fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
  return fd;
}

}  // namespace

TEST_CASE("a question is answered with a line", "[output][control]") {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path / "ctl";
  Serving serving(path);
  CHECK(ask(path, "status") == R"({"state": "running"})");
  CHECK(ask(path, "save") == "{}");
  CHECK(serving.saves == 1);
  CHECK_THAT(ask(path, "dance"), Catch::Contains("unknown request; known: status, save, reset, trace"));
  CHECK_THAT(ask(path, ""), Catch::Contains("unknown request"));
}

TEST_CASE("clients that say nothing, too much, or fetch nothing do not keep others waiting",
          "[output][control]") {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path / "ctl";
  Serving serving(path);
  std::vector<int> clients;
  for (int i = 0; i < 4; ++i) clients.push_back(connect_raw(path));  // silent
  const int talker = connect_raw(path);
  const std::string much(100'000, 'x');
  send(talker, much.data(), much.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  const int lazy = connect_raw(path);
  for (int i = 0; i < 10'000; ++i) send(lazy, "status\n", 7, MSG_NOSIGNAL | MSG_DONTWAIT);
  CHECK(ask(path, "status") == R"({"state": "running"})");
  for (const int fd : clients) close(fd);
  close(talker);
  close(lazy);
}

TEST_CASE("a request that goes wrong is answered too, and harms nobody", "[output][control]") {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path / "ctl";
  ControlServer server(path);
  const int client = connect_raw(path);
  send(client, "status\n", 7, MSG_NOSIGNAL);
  server.serve([](Request) -> std::string { throw std::runtime_error("broken"); });
  std::array<char, 256> answer{};
  CHECK(recv(client, answer.data(), answer.size() - 1, 0) > 0);
  CHECK_THAT(answer.data(), Catch::Contains("error"));
  close(client);
}

TEST_CASE("a socket is never put in a file's place", "[output][control]") {
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "robot.toml";
  std::ofstream(file) << "[mount]\n";
  CHECK_THROWS_WITH(ControlServer(file.string()), Catch::Contains("file of another kind"));
  CHECK(std::filesystem::file_size(file) == 8);
}

TEST_CASE("a socket has one server, what a dead one left is replaced, it is its user's alone",
          "[output][control]") {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path / "ctl";
  {
    const int left_behind = socket(AF_UNIX, SOCK_STREAM, 0);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strcpy(address.sun_path, path.c_str());
    REQUIRE(bind(left_behind, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0);
    close(left_behind);
  }
  {
    const Serving serving(path);
    CHECK_THROWS_WITH(ControlServer(path), Catch::Contains("another running pago listens there"));
    struct stat about {};
    REQUIRE(stat(path.c_str(), &about) == 0);
    CHECK((about.st_mode & 0777) == 0600);
  }
  CHECK_THROWS_WITH(ask(path, "status"), Catch::Contains("no running pago listens there"));
  CHECK_THROWS_AS(ControlServer(std::string(200, 'x')), Error);
  CHECK_THROWS_AS(ControlServer((scratch.path / "no" / "ctl").string()), Error);
}
