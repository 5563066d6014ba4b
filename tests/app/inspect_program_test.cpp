// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "app/program.hpp"
#include "support/data.hpp"
#include "support/packet_stream.hpp"
#include "support/status_cycle.hpp"

using namespace pago;
using namespace pago::test;

namespace {

constexpr int kPackets = 6000, kFirstLost = 5000, kLost = 10;

hdl64::Calibration own_unit() {
  hdl64::Calibration unit = ideal_calibration();
  for (hdl64::LaserCalibration& laser : unit.lasers) {
    laser.distance_m = laser.distance_x_m = laser.distance_y_m = 1.2;
    laser.max_intensity = 255;
  }
  return unit;
}

/// An S3 that says what it is in its status bytes, with ten packets lost and somebody else's datagrams.
void write_s3(const fs::path& file) {
  const PacketStream stream;
  const StatusCycle cycle = make_status_cycle(
      own_unit(), {.says = {.temperature_c = 31, .firmware = 0x47, .warnings = hdl64::kLensDirty}});
  PcapWriter writer(file);
  for (int i = 0; i < kPackets; ++i) {
    PacketBytes bytes = stream.packet(i);
    const StatusByte& said = cycle[static_cast<std::size_t>(i) % cycle.size()];
    bytes[1204] = said.type, bytes[1205] = said.value;
    if (i < kFirstLost || i >= kFirstLost + kLost) writer.write_udp(bytes, stream.arrival_ns(i));
    if (i % 1000 == 0) writer.write_udp(Octets(512), stream.arrival_ns(i), {.destination_port = 8308});
  }
}

struct InspectFolder {
  InspectFolder() { write_s3(street.path() / "s3/s3.pcap"); }
  Outcome run(const std::string& arguments) const { return run_pago(street.path(), arguments); }

  struct Street : StreetFolder {
    Street() : StreetFolder(1) { fs::create_directories(path() / "s3"); }
  } street;
};

bool says(const Outcome& outcome, const std::string& words) {
  return outcome.out.find(words) != std::string::npos;
}

}  // namespace

TEST_CASE("inspect tells on one screen what a stream is", "[app][inspect]") {
  const InspectFolder folder;
  const Outcome screen = folder.run("inspect s3/s3.pcap");
  INFO(screen.out << screen.err);
  REQUIRE(screen.exit_code == 0);
  CHECK(count_lines(screen.out) <= 24);
  for (const char* words :
       {"HDL-64E S3, single return", "firmware 4.07", "192.168.3.43:443", "3472.2 per second",
        "one every 48.0 us", "10.000 per second (600 rpm)", "in the stream (CRC-16 right)",
        "31 C, clean the lens", "60 of 36000 firings", "6 datagrams, no sensor that is known"}) {
    CAPTURE(words);
    CHECK(says(screen, words));
  }

  const Outcome object = folder.run("inspect s3/s3.pcap --json");
  REQUIRE(object.exit_code == 0);
  const auto json = nlohmann::json::parse(object.out);
  CHECK(json["firings"]["lost"] == 6 * kLost);
  CHECK(json["firings"]["decoded"] == 6 * (kPackets - kLost));
  CHECK(json["packets"]["decoded"] == kPackets - kLost);
  CHECK(json["calibration"]["in_stream"] == true);
  CHECK(json["health"]["temperature_c"] == 31);
  CHECK(json["senders"].size() == 2);
}

TEST_CASE("inspect and run tell a wrong calibration file, with the difference", "[app][inspect]") {
  const InspectFolder folder;
  const Outcome screen = folder.run("inspect s3/s3.pcap --calibration calibration.yaml");
  INFO(screen.out << screen.err);
  REQUIRE(screen.exit_code == 0);
  CHECK(says(screen, "NOT this unit's"));
  CHECK(says(screen, "1.2000 m distance"));

  const Outcome run = folder.run("run s3/s3.pcap --calibration calibration.yaml");
  INFO(run.err);
  CHECK(run.exit_code == 0);
  CHECK(run.err.find("wrong calibration: calibration.yaml") != std::string::npos);
  CHECK(run.err.find("1.200 m in their distances") != std::string::npos);
}

TEST_CASE("without a file a run uses the calibration that the sensor sends", "[app][inspect]") {
  const InspectFolder folder;
  const Outcome run = folder.run("run s3/s3.pcap");
  INFO(run.out << run.err);
  REQUIRE(run.exit_code == 0);
  CHECK(says(run, "the sensor's own, from its status bytes"));
  const auto report = nlohmann::json::parse(read_text(folder.street.path() / "results/latest/run.json"));
  CHECK(report["facts"]["calibration"] == "sensor");
  CHECK(report["facts"]["firmware"] == "4.07");
  CHECK(report["facts"]["sensor temperature"] == "31 C");
  CHECK(report["facts"]["sensor warning"] == "clean the lens");
  CHECK(run.err.find("the sensor says: clean the lens") != std::string::npos);
  require_one_line_and_code_2(folder.run("run street.pcap --calibration sensor"), "does not send its own");
}

TEST_CASE("inspect looks at a part of a capture, and says when nothing is there", "[app][inspect]") {
  const InspectFolder folder;
  const Outcome part = folder.run("inspect s3/s3.pcap --start 0.5 --duration 0.288 --json");
  INFO(part.out << part.err);
  REQUIRE(part.exit_code == 0);
  CHECK(nlohmann::json::parse(part.out)["packets"]["decoded"] == 1000);

  const Outcome none = folder.run("inspect s3/s3.pcap --set packets.port=9");
  CHECK(none.exit_code == 2);
  CHECK(says(none, "192.168.3.43:443 to port 2368"));
  CHECK(none.err.find("packets.port") != std::string::npos);
  require_one_line_and_code_2(folder.run("inspect missing.pcap"), "missing.pcap");
}

TEST_CASE("a capture of another port is told, with what it holds", "[app][inspect]") {
  const InspectFolder folder;
  const PacketStream stream;
  {
    PcapWriter writer(folder.street.path() / "other.pcap");
    for (int i = 0; i < 100; ++i)
      writer.write_udp(stream.packet(i), stream.arrival_ns(i), {.destination_port = 2369});
    const PcapWriter empty(folder.street.path() / "empty.pcap");
  }
  const Outcome screen = folder.run("inspect other.pcap");
  INFO(screen.out << screen.err);
  CHECK(screen.exit_code == 2);
  CHECK(says(screen, "192.168.3.43:443 to port 2369: 100 datagrams, HDL-64E in single-return mode"));
  CHECK(screen.err.find("packets.port") != std::string::npos);
  CHECK(folder.run("inspect other.pcap --set packets.port=2369").exit_code == 0);
  require_one_line_and_code_2(folder.run("run other.pcap --calibration calibration.yaml"),
                              "HDL-64E in single-return mode from 192.168.3.43 to port 2369");
  CHECK(folder.run("inspect empty.pcap").err.find("holds no UDP datagram") != std::string::npos);
}

TEST_CASE("inspect of a live sensor that does not send says what to look at", "[app][inspect]") {
  const InspectFolder folder;
  const Outcome outcome = folder.run("inspect udp://127.0.0.1:0 --duration 0.2");
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.err.find("is the sensor on and cabled") != std::string::npos);
}

TEST_CASE("inspect names other sensors", "[app][inspect]") {
  PAGO_DATA_OR_SKIP(captures, "packets/captures");
  const TemporaryPath folder("");
  fs::create_directories(folder.path());
  const Outcome other =
      run_pago(folder.path(), "inspect '" + (captures / "monterey-first-100-packets.pcap").string() + "'");
  INFO(other.out << other.err);
  CHECK(other.exit_code == 2);
  CHECK(says(other, "HDL-32E"));
  CHECK_FALSE(says(other, "(used)"));
}
