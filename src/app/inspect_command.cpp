// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <memory>

#include "commands.hpp"
#include "inspection.hpp"
#include "pago/config/load.hpp"
#include "pago/config/packet_filter.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/run_status.hpp"
#include "pago/platform/clock.hpp"
#include "pago/udp/udp_source.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "signals.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

namespace fs = std::filesystem;

constexpr double kLiveSeconds = 3.0;  // two rounds of a sensor's own calibration

struct InspectOptions {
  std::string source, calibration;
  bool json = false;
  PartOptions part;
  SettingsOptions settings;
};

/// Everything that comes until the source ends or the time is up: what `filter` takes closely, of the rest
/// the senders.
void look_at(PacketSource& source,
             const PacketFilter& filter,
             double seconds,
             Inspection& found,
             StreamSurvey& survey) {
  ProgressLine progress;
  const std::int64_t until_ns = platform::monotonic_ns() + static_cast<std::int64_t>(seconds * 1e9);
  std::int64_t first_ns = 0, last_ns = 0;
  while (!source.all_done() && !stop_requested() && (seconds == 0.0 || platform::monotonic_ns() < until_ns)) {
    for (const Datagram& datagram : source.receive()) {
      if (!filter.takes(datagram.source_ipv4, datagram.destination_port)) {
        survey.note_sender(datagram);
        continue;
      }
      if (first_ns == 0) first_ns = datagram.arrival_ns;
      last_ns = datagram.arrival_ns;
      survey.add(datagram);
    }
    progress.show(source.progress());
  }
  survey.finish();
  found.seconds = static_cast<double>(last_ns - first_ns) * 1e-9;
  found.counters = source.counters();
  found.complaint = source.complaint();
}

/// No packet was looked at closely. Why?
[[noreturn]] void complain_of_nothing(const std::string& source, bool is_file, const Inspection& found) {
  if (!found.survey.senders().empty())
    throw Error(source, "nothing in it is asked for",
                "its senders are listed above; set packets.port or packets.source_address");
  if (is_file) throw Error(source, "holds no UDP datagram", "was the sensor's network recorded?");
  IngestStatus status;
  status.source = found.counters;
  throw Error(source, "nothing to look at came", explain(stream_state(status, 0), status, source));
}

int inspect_packets(const InspectOptions& options, Config& config, PacketSource& source, double seconds) {
  const bool is_file = seconds == 0.0;
  std::string note;
  const auto calibration = calibration_for(is_file ? fs::path(options.source) : fs::path(), config, note);
  StreamSurvey survey(config.hdl64, calibration);
  Inspection found{.source = options.source,
                   .counters = {},
                   .survey = survey,
                   .calibration = calibration,
                   .config = config.hdl64,
                   .complaint = {}};
  PacketFilter filter = PacketFilter::of(config.packets);
  if (!is_file) filter.port = 0;  // the socket's own
  look_at(source, filter, seconds, found, survey);
  std::cout << (options.json ? inspection_json(found) : inspection_text(found));
  if (survey.ingest().packets().received == 0) complain_of_nothing(options.source, is_file, found);
  return survey.ingest().packets().decoded > 0 ? 0 : 2;
}

int inspect_folder(const InspectOptions& options, const Config& config, const fs::path& folder) {
  KittiSource scans(folder, config.kitti);
  Sweep sweep(KittiSource::kMaxPoints);
  std::uint64_t count = 0, points = 0;
  std::int64_t first_ns = 0, last_ns = 0;
  ProgressLine progress;
  while (!stop_requested() && scans.fill(sweep)) {
    if (count++ == 0) first_ns = sweep.header.start_ns;
    last_ns = sweep.header.end_ns;
    points += sweep.size;
    sweep.reset();
    progress.show(scans.progress());
  }
  const std::string what = scans.is_compensated() ? "compensated" : "raw";
  std::cout << format(
      "%-12s %s\n%-12s %llu, %s, %s\n%-12s %.1f s, %.0f points in each\n%-12s %llu scans are not "
      "ring by ring: their rings are guessed\n",
      "source", options.source.c_str(), "scans", static_cast<unsigned long long>(count), what.c_str(),
      scans.has_stamps() ? "with stamps" : "without stamps", "length",
      static_cast<double>(last_ns - first_ns) * 1e-9,
      static_cast<double>(points) / static_cast<double>(std::max<std::uint64_t>(1, count)), "rings",
      static_cast<unsigned long long>(scans.scans_with_guessed_rings()));
  if (!scans.complaint().empty()) throw Error(options.source, scans.complaint());
  return 0;
}

int inspect_command(const InspectOptions& options) {
  stop_on_signals();
  Config config = options.settings.load();
  if (!options.calibration.empty()) config.hdl64.calibration = options.calibration;
  options.part.apply(config);
  validate(config);
  if (options.source.starts_with("udp:")) {
    UdpSource source(parse_udp_endpoint(options.source), config.packets, config.udp);
    const double seconds = config.capture.duration_s;
    return inspect_packets(options, config, source, seconds > 0.0 ? seconds : kLiveSeconds);
  }
  const bool is_kitti = options.source.starts_with("kitti:");
  const bool is_pcap = options.source.starts_with("pcap:");
  const fs::path path = options.source.substr(is_kitti ? 6 : is_pcap ? 5 : 0);
  std::error_code unknown;
  if (is_kitti || (!is_pcap && fs::is_directory(path, unknown))) {
    if (options.json) throw Error(options.source, "holds scans: --json is for packets");
    return inspect_folder(options, config, path);
  }
  PcapSource source(path, {.port = 0, .source_address = {}}, config.capture);
  return inspect_packets(options, config, source, 0.0);
}

}  // namespace

void add_inspect_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand("inspect", "what is this stream?");
  const auto options = std::make_shared<InspectOptions>();
  command
      .add_option("source", options->source,
                  "drive.pcap, udp://:2368 (a live sensor, for three seconds), or a folder of KITTI scans")
      ->type_name("SOURCE")
      ->required();
  command
      .add_option("--calibration", options->calibration,
                  "hold this db.xml or ROS yaml against what the sensor says; default: the one beside the "
                  "capture")
      ->type_name("FILE");
  command.add_flag("--json", options->json, "print one JSON object");
  options->part.add_to(command);
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return inspect_command(*options); }; });
}

}  // namespace pago::app
