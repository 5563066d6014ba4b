// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "pago/config/drivers.hpp"
#include "pago/core/error.hpp"
#include "pago/core/histogram.hpp"
#include "pago/core/text.hpp"
#include "pago/core/units.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/paced_source.hpp"
#include "pago/platform/clock.hpp"
#include "pago/udp/udp_sender.hpp"
#include "progress_line.hpp"
#include "signals.hpp"

namespace pago::app {

namespace {

/// Waking costs more than sending: at this interval playing takes 2 % of a core.
constexpr std::int64_t kInterval_ns = 4'000'000;

struct PlayOptions {
  std::string file, to = "127.0.0.1:2368";
  double speed = 1.0;
  bool loops = false;
  PacketFilterConfig filter;
};

struct Played {
  std::uint64_t rounds = 0;
  LatencyHistogram lateness;
};

/// Sends the whole capture once. Each datagram is late by the time from when it was due until it is sent.
void play_once(const PlayOptions& options, UdpSender& sender, ProgressLine& line, Played& played) {
  PcapSource capture(options.file, options.filter);
  PacedSource paced(capture, options.speed, kInterval_ns);
  while (!paced.all_done() && !stop_requested()) {
    const std::span<const Datagram> batch = paced.receive();
    if (batch.empty()) continue;
    sender.send(batch);
    const std::int64_t now_ns = platform::realtime_ns();
    for (const Datagram& datagram : batch) played.lateness.record(now_ns - datagram.arrival_ns);
    line.show(paced.progress());
  }
  if (!capture.complaint().empty()) throw std::runtime_error(capture.complaint());
  ++played.rounds;
}

std::string summary(const UdpSender& sender, const Played& played, double wall_s, double cpu_s) {
  return format("sent      %llu datagrams in %.1f s, %llu not taken by the kernel\n",
                static_cast<unsigned long long>(sender.sent()), wall_s,
                static_cast<unsigned long long>(sender.unsent())) +
         format("late      p50 %.2f  p99 %.2f  max %.2f ms\n", milliseconds(played.lateness.percentile(50)),
                milliseconds(played.lateness.percentile(99)), milliseconds(played.lateness.max())) +
         format("cpu       %.1f %% of a core\n", 100.0 * cpu_s / wall_s);
}

int play_command(const PlayOptions& options) {
  UdpSender sender(parse_udp_endpoint(options.to));
  stop_on_signals();
  Played played;
  const std::int64_t start_ns = platform::monotonic_ns(), cpu_start_ns = platform::thread_cpu_ns();
  {
    ProgressLine line;
    do play_once(options, sender, line, played);
    while (options.loops && !stop_requested());
  }
  if (sender.sent() + sender.unsent() == 0)
    throw Error(options.file, "holds no datagram to port " + std::to_string(options.filter.port),
                "--port 0 plays all of them");
  const double wall_s = static_cast<double>(platform::monotonic_ns() - start_ns) * 1e-9;
  const double cpu_s = static_cast<double>(platform::thread_cpu_ns() - cpu_start_ns) * 1e-9;
  std::cout << summary(sender, played, wall_s, cpu_s);
  return sender.unsent() == 0 ? 0 : 1;
}

}  // namespace

void add_play_command(CLI::App& program, Action& action) {
  CLI::App& command =
      *program.add_subcommand("play", "send a capture's datagrams as the sensor did, at the same pace");
  const auto options = std::make_shared<PlayOptions>();
  command.add_option("file", options->file, "the capture")->type_name("FILE")->required();
  command.add_option("--to", options->to, "where to send them; default: 127.0.0.1:2368")
      ->type_name("ADDRESS:PORT");
  command.add_option("--speed", options->speed, "so many times as fast; default: 1")
      ->check(CLI::Range(0.001, 1000.0).description(""))
      ->type_name("X");
  command.add_flag("--loop", options->loops, "again from the start, until stopped");
  command
      .add_option("--port", options->filter.port,
                  "of the captured datagrams, those to this port; 0: all; default: 2368")
      ->check(CLI::Range(0, 65535).description(""))
      ->type_name("PORT");
  command.callback([&action, options] { action = [options] { return play_command(*options); }; });
}

}  // namespace pago::app
