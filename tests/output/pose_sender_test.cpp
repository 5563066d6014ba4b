// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/pose_sender.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "output/scratch_folder.hpp"
#include "pago/core/error.hpp"
#include "support/catch.hpp"

using namespace pago;
using namespace pago::output;

namespace {

/// A bound socket of this host that others can send to.
struct Listener {
  int fd = socket(AF_INET, SOCK_DGRAM, 0);
  int port = 0;
  Listener() {
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof at;
    bind(fd, reinterpret_cast<const sockaddr*>(&at), length);
    getsockname(fd, reinterpret_cast<sockaddr*>(&at), &length);
    port = ntohs(at.sin_port);
  }
  ~Listener() { close(fd); }
  std::string address() const { return "127.0.0.1:" + std::to_string(port); }
};

PoseV1 example_pose() {
  PoseV1 pose{};
  pose.magic = PAGO_POSE_V1;
  pose.kind = PAGO_POSE_REFINED;
  pose.health = PAGO_HEALTH_LOST;
  pose.reason = static_cast<std::uint8_t>(HealthReason::kTooFewFeatures);
  pose.sequence = 3;
  pose.stamp_ns = 1'700'000'000'123'456'789;
  std::strcpy(pose.frame_id, "odom");
  std::strcpy(pose.child_frame_id, "base_link");
  pose.position_m[1] = 0.1;
  pose.orientation_xyzw[3] = 1.0;
  pose.covariance[35] = 1e-9;
  return pose;
}

}  // namespace

TEST_CASE("a pose arrives as a datagram of its bytes", "[output][pose_sender]") {
  const Listener listener;
  PoseSender sender(listener.address());
  const PoseV1 sent = example_pose();
  sender.send(sent);
  PoseV1 got{};
  REQUIRE(recv(listener.fd, &got, sizeof got, 0) == sizeof got);
  CHECK(std::memcmp(&got, &sent, sizeof got) == 0);
  CHECK(sender.unsent() == 0);
}

TEST_CASE("nobody need listen", "[output][pose_sender]") {
  std::string nobody;
  {
    const Listener gone;
    nobody = gone.address();
  }
  PoseSender sender(nobody);
  for (int i = 0; i < 10; ++i) sender.send(example_pose());
  CHECK(sender.unsent() == 0);
}

TEST_CASE("a destination that is none is refused by its key", "[output][pose_sender]") {
  for (const char* wrong :
       {"localhost:9760", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:x", ":9760"})
    CHECK_THROWS_WITH(PoseSender(wrong), Catch::StartsWith("publish.udp"));
}

TEST_CASE("a pose is a line of JSON with every digit", "[output][pose_sender]") {
  const std::string line = pose_line(example_pose());
  CHECK(line.back() == '\n');
  CHECK(line.find('\n') == line.size() - 1);
  const auto json = nlohmann::json::parse(line);
  CHECK(json["kind"] == "refined");
  CHECK(json["health"] == "LOST");
  CHECK(json["reason"] == "too few features");
  CHECK(json["stamp_ns"] == 1'700'000'000'123'456'789);
  CHECK(json["child_frame_id"] == "base_link");
  CHECK(json["position_m"][1] == 0.1);
  CHECK(json["covariance"].size() == 36);
  CHECK(json["covariance"][35] == 1e-9);
}

TEST_CASE("lines reach their file at once", "[output][pose_sender]") {
  const test::ScratchFolder scratch;
  const auto file = scratch.path / "poses.jsonl";
  PoseLines lines(file.string());
  lines.write(example_pose());
  CHECK(test::contents(file) == pose_line(example_pose()));
  CHECK(lines.complaint().empty());
  CHECK_THROWS_AS(PoseLines((scratch.path / "no" / "folder").string()), Error);
}
