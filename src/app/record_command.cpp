// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/pcap/recording_source.hpp"
#include "pago/pipeline/run_status.hpp"
#include "pago/platform/clock.hpp"
#include "pago/udp/udp_source.hpp"
#include "settings.hpp"
#include "signals.hpp"

namespace pago::app {

namespace {

namespace fs = std::filesystem;

struct RecordOptions {
  std::string source, output;
  double duration_s = 0.0;
  SettingsOptions settings;
};

/// A folder gets a capture named by the time: 2026-11-27_19-30-00.pcap, UTC.
std::string file_in(const std::string& output) {
  std::error_code unknown;
  if (!fs::is_directory(output, unknown) && !output.ends_with('/')) return output;
  fs::create_directories(output, unknown);  // where it cannot be, the recorder says so
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  const std::string name = format("%04d-%02d-%02d_%02d-%02d-%02d.pcap", utc.tm_year + 1900, utc.tm_mon + 1,
                                  utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
  return (fs::path(output) / name).string();
}

/// Until it is stopped, or the time is up.
void record(PacketSource& source, double duration_s) {
  const std::int64_t start_ns = platform::monotonic_ns();
  const auto is_up = [&] {
    return duration_s > 0.0 && static_cast<double>(platform::monotonic_ns() - start_ns) >= duration_s * 1e9;
  };
  while (!source.all_done() && !stop_requested() && !is_up()) source.receive();
}

std::string summary(const PcapRecorder& recorder, const SourceCounters& source) {
  const RecordCounters c = recorder.counters();
  const auto number = [](std::uint64_t n) { return static_cast<unsigned long long>(n); };
  return format("recorded  %llu datagrams, %.1f MB, in %s\n", number(c.written),
                static_cast<double>(c.bytes) * 1e-6, recorder.files().c_str()) +
         format("lost      %llu not written, %llu dropped by the kernel\n", number(c.unwritten()),
                number(source.kernel_dropped));
}

int record_command(const RecordOptions& options) {
  if (!options.source.starts_with("udp:"))
    throw Error(options.source, "is no live sensor", "record from udp://:2368");
  Config config = options.settings.load();
  if (!options.output.empty()) config.record.file = options.output;
  if (config.record.file.empty()) config.record.file = "./";
  config.record.file = file_in(config.record.file);
  validate(config);
  stop_on_signals();
  UdpSource sensor(parse_udp_endpoint(options.source), config.packets, config.udp);
  PcapRecorder recorder(config.record);
  for (const std::string& warning : sensor.warnings()) std::cerr << "pago: " << warning << '\n';
  RecordingSource source(sensor, recorder);
  record(source, options.duration_s);
  recorder.finish();
  std::cout << summary(recorder, source.counters());
  std::vector<std::string> complaints{recorder.complaint(), source.complaint()};
  IngestStatus now;
  now.source = source.counters();
  if (now.source.delivered == 0) complaints.push_back(explain(stream_state(now, 0), now, options.source));
  std::erase(complaints, "");
  for (const std::string& complaint : complaints) std::cerr << "pago: " << complaint << '\n';
  return complaints.empty() ? 0 : 1;
}

}  // namespace

void add_record_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("record", "keep what a live sensor sends, as a capture");
  const auto options = std::make_shared<RecordOptions>();
  command.add_option("source", options->source, "udp://:2368 (a live sensor)")
      ->type_name("SOURCE")
      ->required();
  command
      .add_option("-o,--output", options->output,
                  "the capture, or a folder that gets one named by the time; default: this folder. "
                  "`--set record.file_mb=1000` makes a new file whenever one has this size")
      ->type_name("PATH");
  command.add_option("--duration", options->duration_s, "ends after so many seconds; default: when stopped")
      ->check(CLI::Range(0.0, 1e9).description(""))
      ->type_name("SECONDS");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return record_command(*options); }; });
}

}  // namespace pago::app
