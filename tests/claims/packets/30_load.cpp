// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Two live sensors at once over loopback UDP, an S2.1 and an S3 in dual-return mode, each at its own rate,
// for 10 minutes (or as many seconds as the argument says). Each is received on a port of its own, at the
// priority of a live run, by a thread that is stopped for 100 ms every second: nothing may be lost, and
// receiving, decoding and assembly may take 5 % of a core. The bytes are the synthetic captures' again and
// again, with stamps and azimuths that go on.
#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/config/pipeline.hpp"
#include "pago/platform/clock.hpp"
#include "pago/platform/thread.hpp"
#include "pago/udp/udp_sender.hpp"
#include "pago/udp/udp_source.hpp"
#include "support/capture.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::recording;
using claims::Report;

namespace {

constexpr double kMostOfACore_percent = 5.0;
constexpr std::int64_t kSecond_ns = 1'000'000'000, kStall_ns = 100'000'000;
constexpr std::int64_t kSendEvery_ns = 2'000'000;
constexpr double kRotation_hz = 10.0;
constexpr int kEncoderStep_cdeg = 9;

struct Sensor {
  std::string name, capture, calibration;
  std::int64_t packet_period_ns;
  int blocks_per_firing;
};

struct Sink final : SweepExchange {
  Sweep* acquire() noexcept override { return ring.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    if (part.last) ring.release(part.sweep);
  }
  SweepRing ring{2, max_returns_of(AssemblyConfig{}, /*can_be_dual=*/true)};
};

/// The capture's bytes as packet `index` of a stream without end.
void carry_on(std::span<std::uint8_t> packet, const Sensor& sensor, std::int64_t index) {
  const std::int64_t after_ns = index * sensor.packet_period_ns;
  const std::int64_t firing_ns = sensor.packet_period_ns * sensor.blocks_per_firing / hdl64::kBlocks;
  for (int block = 0; block < hdl64::kBlocks; ++block) {
    const std::int64_t at_ns = after_ns + block / sensor.blocks_per_firing * firing_ns;
    const double turned_cdeg = static_cast<double>(at_ns) * 1e-9 * kRotation_hz * 36'000.0;
    const auto steps = static_cast<std::int64_t>(turned_cdeg / kEncoderStep_cdeg);
    const auto azimuth_cdeg = static_cast<std::uint16_t>(steps * kEncoderStep_cdeg % 36'000);
    std::memcpy(&packet[static_cast<std::size_t>(block) * hdl64::kBlockBytes + 2], &azimuth_cdeg, 2);
  }
  const auto stamp_us = static_cast<std::uint32_t>(after_ns / 1000 % hdl64::kStampWrap_us);
  std::memcpy(&packet[1200], &stamp_us, 4);
}

/// Sends what is due every 2 ms; returns how many.
std::uint64_t send(const Sensor& sensor, int port, std::int64_t duration_ns) {
  std::vector<test::CapturedPacket> packets = test::read_capture(recording(sensor.capture));
  UdpSender sender({"127.0.0.1", port});
  const std::int64_t start_ns = platform::monotonic_ns();
  std::vector<Datagram> due;
  for (std::int64_t index = 0, now_ns = start_ns; now_ns - start_ns < duration_ns;) {
    due.clear();
    while (due.size() < UdpSource::kBatch && index * sensor.packet_period_ns <= now_ns - start_ns) {
      auto& payload = packets[static_cast<std::size_t>(index) % packets.size()].payload;
      carry_on(payload, sensor, index++);
      due.push_back({.payload = payload});
    }
    sender.send(due);
    if (due.size() < UdpSource::kBatch) platform::sleep_until_ns(now_ns + kSendEvery_ns);
    now_ns = platform::monotonic_ns();
  }
  return sender.sent();
}

struct Received {
  SourceCounters source;
  PacketCounters packets;
  FiringCounters firings;
  AssemblyCounters sweeps;
  double percent = 0.0;  // of a core
  int stalls = 0;
};

/// Receives until nothing comes any more after `stop`.
Received receive(UdpSource& source, const hdl64::Calibration& unit, const std::atomic<bool>& stop) {
  Sink sink;
  PacketIngest ingest({}, {}, unit, sink);
  Received result;
  const std::int64_t start_ns = platform::monotonic_ns(), cpu_start_ns = platform::thread_cpu_ns();
  std::int64_t next_stall_ns = start_ns + kSecond_ns;
  for (bool is_over = false; !is_over;) {
    const bool was_last_sent = stop;
    const std::span<const Datagram> batch = source.receive();
    is_over = was_last_sent && batch.empty();
    for (const Datagram& datagram : batch) ingest.push(datagram);
    if (platform::monotonic_ns() < next_stall_ns) continue;
    platform::sleep_until_ns(platform::monotonic_ns() + kStall_ns);
    next_stall_ns += kSecond_ns;
    ++result.stalls;
  }
  result.percent = 100.0 * static_cast<double>(platform::thread_cpu_ns() - cpu_start_ns) /
                   static_cast<double>(platform::monotonic_ns() - start_ns);
  ingest.finish();
  result.source = source.counters();
  result.packets = ingest.packets();
  result.firings = ingest.firings();
  result.sweeps = ingest.sweeps();
  return result;
}

struct Outcome {
  std::uint64_t sent = 0;
  int priority = 0;  // of the receiving thread, as granted
  Received received;
};

void run_sensor(const Sensor& sensor, std::int64_t duration_ns, Outcome& outcome) {
  const auto unit = hdl64::load_calibration(recording(sensor.calibration), VerticalOffset::kVertical);
  UdpSource source({"127.0.0.1", 0});
  std::atomic<bool> stop{false};
  const ThreadConfig live = PipelineConfig{}.ingest;
  platform::Thread receiver({.name = "ingest", .fifo_priority = live.fifo_priority},
                            [&] { outcome.received = receive(source, unit, stop); });
  outcome.priority = receiver.grant().fifo_priority;
  outcome.sent = send(sensor, source.port(), duration_ns);
  stop = true;
  receiver.join();
}

void tell(Report& report, const Sensor& sensor, const Outcome& outcome, double duration_s) {
  const std::string name = "load " + sensor.name + ": ";
  const Received& r = outcome.received;
  report.shown(name + "stalls of 100 ms", std::to_string(r.stalls));
  report.shown(name + "priority of the receiving thread", std::to_string(outcome.priority));
  const double rate_s = 1e9 / static_cast<double>(sensor.packet_period_ns);
  report.at_least(name + "packets sent per second", static_cast<double>(outcome.sent) / duration_s,
                  0.99 * rate_s, "");
  report.exactly(name + "packets decoded, of those sent", r.packets.decoded, outcome.sent);
  report.exactly(name + "datagrams that the kernel dropped", r.source.kernel_dropped, 0);
  report.exactly(name + "firings lost", r.firings.lost, 0);
  report.exactly(name + "sweeps lost or incomplete", r.sweeps.no_free_sweep + r.sweeps.incomplete, 0);
  report.at_most(name + "ingest, of a core", r.percent, kMostOfACore_percent, " %");
}

void measure(Report& report, double duration_s) {
  const std::array sensors{Sensor{"S2", "packets/synthetic/synth_S2.pcap",
                                  "packets/calibration/ros-drivers_64e_s2.1-sztaki.xml", 288'000, 2},
                           Sensor{"S3 dual", "packets/synthetic/synth_S3D.pcap",
                                  "packets/calibration/ros-drivers_64e_s3-xiesc.yaml", 172'800, 4}};
  for (const Sensor& sensor : sensors) {  // a thread could not say that they are missing
    recording(sensor.capture);
    recording(sensor.calibration);
  }
  std::array<Outcome, sensors.size()> outcomes;
  std::array<std::thread, sensors.size()> threads;
  const auto duration_ns = static_cast<std::int64_t>(duration_s * 1e9);
  for (std::size_t i = 0; i < sensors.size(); ++i)
    threads[i] = std::thread([&, i] { run_sensor(sensors[i], duration_ns, outcomes[i]); });
  for (std::thread& thread : threads) thread.join();
  for (std::size_t i = 0; i < sensors.size(); ++i) tell(report, sensors[i], outcomes[i], duration_s);
}

}  // namespace

int main(int argc, char** argv) {
  const double duration_s = argc > 1 ? std::atof(argv[1]) : 600.0;
  return claims::run("load", [duration_s](Report& report) { measure(report, duration_s); });
}
