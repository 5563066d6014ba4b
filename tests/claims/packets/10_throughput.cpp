// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Datagrams into sweeps on one core, everything included: sensor time, order, status bytes, rotation,
// two-point calibration at each laser's own time and azimuth, range image. Captures lie in memory; time is
// the thread's CPU time, beside that of copying as many bytes as go in and out.
#include <algorithm>
#include <cstring>
#include <optional>
#include <vector>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/platform/clock.hpp"
#include "support/capture.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::recording;
using claims::Report;

namespace {

constexpr double kPackets_s = 600'000.0;
constexpr std::size_t kRounds = 11;
constexpr std::size_t kBytesPerReturn = 30 + 4;  // in a sweep; and its cell of the range image

struct Sink final : SweepExchange {
  explicit Sink(const AssemblyConfig& config) : ring(2, max_returns_of(config, /*can_be_dual=*/true)) {}
  Sweep* acquire() noexcept override { return ring.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    if (!part.last) return;
    returns += part.sweep->size;
    ring.release(part.sweep);
  }
  SweepRing ring;
  std::uint64_t returns = 0;
};

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2),
                   values.end());
  return values[values.size() / 2];
}

struct Run {
  double seconds = 0.0;
  std::uint64_t decoded = 0, returns = 0;
};

Run ingest_all(const std::vector<test::CapturedPacket>& packets, const hdl64::Calibration& unit) {
  const AssemblyConfig config;
  Sink sink(config);
  PacketIngest ingest(config, {}, unit, sink);
  const std::int64_t start_ns = platform::thread_cpu_ns();
  for (const test::CapturedPacket& packet : packets)
    ingest.push({.payload = packet.payload, .arrival_ns = packet.arrival_ns, .source_ipv4 = 1});
  ingest.finish();
  const std::int64_t spent_ns = platform::thread_cpu_ns() - start_ns;
  return {static_cast<double>(spent_ns) * 1e-9, ingest.packets().decoded, sink.returns};
}

/// Time to copy so many bytes from one place to another, neither of them in a cache.
double copy_seconds(std::size_t bytes) {
  static std::vector<std::uint8_t> from(64U << 20U, 1), to(64U << 20U, 2);
  const std::int64_t start_ns = platform::thread_cpu_ns();
  for (std::size_t done = 0; done < bytes; done += from.size())
    std::memcpy(to.data(), from.data(), std::min(from.size(), bytes - done));
  return static_cast<double>(platform::thread_cpu_ns() - start_ns) * 1e-9;
}

void measure(Report& report, const std::string& capture, const std::string& calibration) {
  const auto packets = test::read_capture(recording(capture));
  const auto unit = hdl64::load_calibration(recording(calibration), VerticalOffset::kVertical);
  std::vector<double> rates, ratios;
  Run run;
  for (std::size_t round = 0; round < kRounds; ++round) {
    run = ingest_all(packets, unit);
    const std::size_t bytes = packets.size() * hdl64::kPacketBytes + run.returns * kBytesPerReturn;
    rates.push_back(static_cast<double>(run.decoded) / run.seconds);
    ratios.push_back(run.seconds / copy_seconds(bytes / 2));  // a copy reads and writes
  }
  const std::string name = "throughput " + capture.substr(capture.rfind('/') + 1) + ": ";
  report.exactly(name + "packets decoded", run.decoded, packets.size());
  report.at_least(name + "packets per second of one core, median", median(rates), kPackets_s, "");
  report.shown(name + "per return", format("%.2f ns", 1e9 / median(rates) * static_cast<double>(run.decoded) /
                                                          static_cast<double>(run.returns)));
  report.shown(name + "time against copying as many bytes", format("%.2f", median(ratios)));
}

}  // namespace

int main() {
  return claims::run("throughput", [](Report& report) {
    measure(report, "packets/drive_0005/drive_0005.pcap", "packets/drive_0005/calibration.yaml");
    measure(report, "packets/synthetic/synth_S2.pcap", "packets/calibration/ros-drivers_64e_s2.1-sztaki.xml");
    measure(report, "packets/synthetic/synth_S3.pcap", "packets/calibration/ros-drivers_64e_s3-xiesc.yaml");
    measure(report, "packets/synthetic/synth_S3D.pcap", "packets/calibration/ros-drivers_64e_s3-xiesc.yaml");
  });
}
