// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Streams of a simulated drive (S2.1) and of an S3 in dual-return mode, with faults put in: what is lost,
// doubled, overtaken or refused is counted to the packet.
#include <functional>
#include <string>
#include <vector>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/simulator/simulator.hpp"
#include "support/capture.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::recording;
using claims::Report;

namespace {

constexpr double kSeconds = 2.5;

struct Clean {
  std::string name;
  std::vector<test::CapturedPacket> packets;
  hdl64::Calibration unit;
  std::uint64_t firings_per_packet;
};

struct Sink final : SweepExchange {
  Sweep* acquire() noexcept override { return ring.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    if (part.last) ring.release(part.sweep);
  }
  SweepRing ring{2, max_returns_of(AssemblyConfig{}, /*can_be_dual=*/true)};
};

/// What must be counted besides packets that were decoded.
struct Expected {
  std::uint64_t decoded = 0, missing = 0, duplicate = 0, late = 0, filtered = 0, reordered = 0;
  std::uint64_t flag = 0, azimuth = 0, size = 0;
};

/// A stream on its way to the host.
class Link {
 public:
  explicit Link(const Clean& clean) : clean_(clean), ingest_({}, {}, clean.unit, sink_) {}

  std::size_t size() const { return clean_.packets.size(); }
  void send(std::size_t index) { push(clean_.packets[index].payload, index); }
  void push(std::span<const std::uint8_t> payload, std::size_t index, std::uint32_t from = 1) {
    ingest_.push({.payload = payload, .arrival_ns = clean_.packets[index].arrival_ns, .source_ipv4 = from});
  }
  /// With a byte that was damaged on the way.
  void send_damaged(std::size_t index, std::size_t at, std::uint8_t value) {
    std::vector<std::uint8_t> payload = clean_.packets[index].payload;
    payload[at] = value;
    push(payload, index);
  }
  const PacketIngest& finish() {
    ingest_.finish();
    return ingest_;
  }

 private:
  const Clean& clean_;
  Sink sink_;
  PacketIngest ingest_;
};

/// Sends packet `index`, or does something else; the first and the last packets are sent as they are, so that
/// what is missing lies between them.
using Fault = std::function<void(Link&, std::size_t index, Expected&)>;

void run(Report& report, const Clean& clean, const std::string& fault_name, const Fault& fault) {
  constexpr std::size_t kEdge = 100;
  Link link(clean);
  Expected expected;
  for (std::size_t i = 0; i < link.size(); ++i) {
    if (i < kEdge || i + kEdge >= link.size())
      link.send(i);
    else
      fault(link, i, expected);
  }
  expected.decoded = link.size() - expected.missing;
  const PacketIngest& ingest = link.finish();
  const PacketCounters counted = ingest.packets();
  const auto bad = [&](PacketFault kind) { return counted.bad[static_cast<std::size_t>(kind)]; };
  const auto difference = [](std::uint64_t a, std::uint64_t b) { return a > b ? a - b : b - a; };
  const std::uint64_t wrong =
      difference(counted.decoded, expected.decoded) + difference(counted.duplicate, expected.duplicate) +
      difference(counted.late, expected.late) + difference(counted.filtered, expected.filtered) +
      difference(counted.reordered, expected.reordered) +
      difference(bad(PacketFault::kBlockFlag), expected.flag) +
      difference(bad(PacketFault::kAzimuth), expected.azimuth) +
      difference(bad(PacketFault::kSize), expected.size) +
      difference(ingest.firings().lost, clean.firings_per_packet * expected.missing) +
      (counted.balanced() && ingest.firings().balanced() && ingest.sweeps().balanced() ? 0 : 1);
  const std::uint64_t happened = expected.missing + expected.duplicate + expected.late + expected.filtered +
                                 expected.reordered + expected.size;
  report.exactly("faults " + clean.name + ", " + fault_name + " (" + std::to_string(happened) +
                     "): counts that are wrong",
                 wrong, 0);
}

void run_all(Report& report, const Clean& clean) {
  run(report, clean, "none", [](Link& link, std::size_t i, Expected&) { link.send(i); });
  run(report, clean, "single losses", [](Link& link, std::size_t i, Expected& e) {
    if (i % 20 == 7)
      ++e.missing;
    else
      link.send(i);
  });
  run(report, clean, "bursts of 60 lost", [](Link& link, std::size_t i, Expected& e) {
    if (i % 1000 < 60)
      ++e.missing;
    else
      link.send(i);
  });
  run(report, clean, "doubled", [](Link& link, std::size_t i, Expected& e) {
    link.send(i);
    if (i % 10 != 3) return;
    link.send(i);
    ++e.duplicate;
  });
  run(report, clean, "overtaken by a neighbour", [](Link& link, std::size_t i, Expected& e) {
    if (i % 50 == 10) {
      link.send(i + 1);
      link.send(i);
      ++e.reordered;
    } else if (i % 50 != 11) {
      link.send(i);
    }
  });
  run(report, clean, "20 places late", [](Link& link, std::size_t i, Expected& e) {
    if (i % 200 == 10) return;
    link.send(i);
    if (i % 200 != 30) return;
    link.send(i - 20);
    ++e.late;
    ++e.missing;
  });
  run(report, clean, "damaged flags", [](Link& link, std::size_t i, Expected& e) {
    if (i % 30 != 4) return link.send(i);
    link.send_damaged(i, 300, 0x55);
    ++e.flag;
    ++e.missing;
  });
  run(report, clean, "damaged azimuths", [](Link& link, std::size_t i, Expected& e) {
    if (i % 30 != 4) return link.send(i);
    link.send_damaged(i, 203, 0xFF);
    ++e.azimuth;
    ++e.missing;
  });
  run(report, clean, "cut short", [](Link& link, std::size_t i, Expected& e) {
    if (i % 30 != 4) return link.send(i);
    link.push(std::vector<std::uint8_t>(1200), i);
    ++e.size;
    ++e.missing;
  });
  run(report, clean, "strays of 200 bytes", [](Link& link, std::size_t i, Expected& e) {
    link.send(i);
    if (i % 3 != 0) return;
    link.push(std::vector<std::uint8_t>(200), i);
    ++e.size;
  });
  run(report, clean, "a second sensor", [&clean](Link& link, std::size_t i, Expected& e) {
    link.send(i);
    link.push(clean.packets[(i * 7) % clean.packets.size()].payload, i, 2);
    ++e.filtered;
  });
}

Clean simulated() {
  SimulatorConfig config;
  config.seconds = kSeconds;
  simulator::Simulator drive(config, {}, {});
  Clean clean{"simulated drive", {}, drive.calibration(), 6};
  for (simulator::SimulatedPacket packet; drive.next(packet);)
    clean.packets.push_back({packet.arrival_ns, {packet.bytes.begin(), packet.bytes.end()}});
  return clean;
}

Clean dual() {
  return {"S3 dual", test::read_capture(recording("packets/synthetic/synth_S3D.pcap")),
          hdl64::load_calibration(recording("packets/calibration/ros-drivers_64e_s3-xiesc.yaml"),
                                  VerticalOffset::kVertical),
          3};
}

}  // namespace

int main() {
  return claims::run("faults", [](Report& report) {
    run_all(report, simulated());
    run_all(report, dual());
  });
}
