// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The recorded drive over loopback UDP into a socket with a host's usual small receive buffer, the ingest
// thread put to sleep for 150 ms every 2 s: what the kernel says it dropped is what the sensor's clock says
// is missing.
#include <atomic>
#include <thread>

#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/paced_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/udp/udp_sender.hpp"
#include "tests/claims/live/stalls.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;

namespace {

constexpr int kUsualBuffer_bytes = 212'992 / 2;  // the kernel doubles what is asked
constexpr std::int64_t kStall_ns = 150'000'000, kEvery_ns = 2'000'000'000;
constexpr std::uint64_t kFiringsPerPacket = 6;

struct Quiet final : Observer {
  void on_sweep(const output::SweepRecord&) override {}
};

/// Plays the drive as the sensor sent it, then waits until everything must have been received.
void play(const std::filesystem::path& capture,
          int port,
          std::atomic<std::uint64_t>& sent,
          std::atomic<bool>& stop) {
  PcapSource recorded(capture);
  PacedSource paced(recorded);
  UdpSender sender({"127.0.0.1", port});
  while (!paced.all_done()) sender.send(paced.receive());
  sent = sender.sent();
  std::this_thread::sleep_for(std::chrono::seconds(2));
  stop = true;
}

void measure(Report& report) {
  const auto drive = claims::recording("packets/drive_0005");
  Config config;
  config.publish.shared_memory.clear();
  config.udp.receive_buffer_bytes = kUsualBuffer_bytes;
  config.hdl64.calibration = (drive / "calibration.yaml").string();
  const auto calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  claims::stall = {.thread = "ingest", .length_ns = kStall_ns, .every_ns = kEvery_ns};
  UdpSource source({"127.0.0.1", 0}, config.packets, config.udp);
  std::atomic<std::uint64_t> sent{0};
  std::atomic<bool> stop{false};
  std::thread sensor([&] { play(drive / "drive_0005.pcap", source.port(), sent, stop); });
  Quiet quiet;
  const RunSummary summary = Pipeline(config, Pace::kLive).run(source, calibration, quiet, stop);
  sensor.join();

  const std::uint64_t dropped = summary.source.kernel_dropped;
  report.shown("small receive buffer, stalled ingest: stalls", std::to_string(claims::num_stalls));
  report.at_least("small receive buffer, stalled ingest: datagrams that the kernel dropped",
                  static_cast<double>(dropped), 100.0, "");
  report.exactly("small receive buffer, stalled ingest: received and dropped, of those sent",
                 summary.source.received + dropped, sent);
  report.exactly("small receive buffer, stalled ingest: firings missing by the sensor's clock",
                 summary.firings.lost, kFiringsPerPacket * dropped);
  report.exactly("small receive buffer, stalled ingest: identities that do not hold",
                 summary.balanced() ? 0 : 1, 0);
}

}  // namespace

int main() {
  return claims::run("kernel drops", measure);
}
