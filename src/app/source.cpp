// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "source.hpp"

#include <array>
#include <chrono>
#include <iostream>
#include <optional>

#include "pago/assembly/stream_survey.hpp"
#include "pago/config/packet_filter.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/udp/udp_source.hpp"
#include "signals.hpp"

#ifdef PAGO_HAS_SIMULATOR
#include "pago/config/load.hpp"
#include "pago/simulator/drive_name.hpp"
#include "pago/simulator/labelled_capture.hpp"
#include "pago/simulator/simulator_source.hpp"
#endif

namespace pago::app {

namespace fs = std::filesystem;

namespace {

/// A stream is looked at until its own calibration is known, but not longer than this: five rounds of it.
constexpr std::uint64_t kMostPackets = 5 * hdl64::StatusReader::kRoundPackets;
constexpr const char* kRangesAreWrong =
    "give the unit's own db.xml or yaml with --calibration: without it every range is wrong by about a metre";

/// The rest of `name` after `prefix:`, if it starts so.
std::optional<std::string> after(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix + ":")) return std::nullopt;
  return name.substr(prefix.size() + 1);
}

/// Whether more of a stream must be looked at before it can be used.
bool is_curious(const StreamSurvey& survey) {
  const PacketIngest& ingest = survey.ingest();
  if (ingest.is_refused()) return false;
  const bool is_known = ingest.sensor() != hdl64::SensorKind::kUnknown;
  const bool says_nothing = is_known && !ingest.format().has_stamps();
  return !says_nothing && !ingest.status().has_calibration() && ingest.packets().decoded < kMostPackets;
}

/// "HDL-64E in single-return mode to port 2369": what a capture holds, whoever is asked for; empty if no
/// sensor.
std::string sensor_in(const fs::path& file) {
  PcapSource everything(file, {.port = 0, .source_address = {}});
  StreamSurvey survey;
  for (std::uint64_t n = 0; n < kMostPackets && !everything.all_done();)
    for (const Datagram& datagram : everything.receive()) {
      survey.note_sender(datagram);
      ++n;
    }
  for (const Sender& sender : survey.senders())
    if (sender.sensor != hdl64::SensorKind::kUnknown)
      return std::string(name(sender.sensor)) + " from " + ipv4_text(sender.ipv4) + " to port " +
             std::to_string(sender.destination_port);
  return {};
}

/// A capture of another sensor, or of none, is refused before anything starts.
void check_sensor(const fs::path& file,
                  const PacketFilterConfig& filter,
                  const StreamSurvey& survey,
                  const SourceCounters& counters) {
  if (survey.ingest().is_refused() && counters.delivered > 0)
    throw Error(file.string(), survey.ingest().refusal());
  if (counters.delivered > 0) return;
  const std::string port = std::to_string(filter.port);
  if (counters.bad() > 0) {
    throw Error(
        file.string(), "holds no whole datagram to port " + port,
        std::to_string(counters.truncated) + " are cut short: record with the full length, tcpdump -s 0");
  }
  const std::string sensor = sensor_in(file);
  throw Error(file.string(),
              "holds no datagram to port " + port +
                  (filter.source_address.empty() ? "" : " from " + filter.source_address),
              std::to_string(counters.filtered) + " others" +
                  (sensor.empty() ? "" : ", among them: " + sensor) +
                  "; set packets.port or packets.source_address");
}

/// What is told of the sensor before a run, and what the run needs to know of it.
void take_over(const StreamSurvey& survey, const std::string& source, Config& config, OpenPackets& open) {
  if (config.hdl64.calibration == kSensorsOwn) {
    const auto own = survey.calibration();
    if (!own)
      throw Error(source, "no calibration given, none beside it, and the sensor does not send its own",
                  kRangesAreWrong);
    open.calibration = *own;
    // With a file, a live run learns it on its way, and a replay must do the same.
    open.calibration.power_level = power_level_of(survey.ingest().status().status());
  }
  if (const std::string complaint = survey.complaint(); !complaint.empty())
    open.warnings.push_back(complaint);
  if (!survey.ingest().format().is_dual() && config.assembly.max_returns == 0)
    config.assembly.max_returns = static_cast<int>(max_returns_of(config.assembly, /*can_be_dual=*/false));
}

/// A simulated drive's labels lie beside its packets: packets.labels, packets.pcap.
std::unique_ptr<PacketSource> replay(const fs::path& file,
                                     const Config& config,
                                     const hdl64::Calibration& calibration) {
#ifdef PAGO_HAS_SIMULATOR
  const fs::path labels = fs::path(file).replace_extension(".labels");
  std::error_code unknown;
  if (fs::exists(labels, unknown))
    return std::make_unique<LabelledCapture>(file, config.packets, config.capture, labels, calibration);
#else
  (void)calibration;
#endif
  return std::make_unique<PcapSource>(file, config.packets, config.capture);
}

OpenPackets open_capture(const fs::path& file, Config& config) {
  std::error_code unknown;
  if (fs::is_fifo(file, unknown))
    throw Error(file.string(), "is a pipe", "captures are read twice: give a file");
  OpenPackets open;
  const std::optional<hdl64::Calibration> given = calibration_for(file, config, open.calibration_note);
  if (given) open.calibration = *given;

  PcapSource look(file, config.packets, config.capture);
  StreamSurvey survey(config.hdl64, given);
  while (!look.all_done() && is_curious(survey))
    for (const Datagram& datagram : look.receive()) survey.add(datagram);
  if (look.all_done()) survey.finish();
  check_sensor(file, config.packets, survey, look.counters());
  take_over(survey, file.string(), config, open);
  open.packets = replay(file, config, open.calibration);
  return open;
}

/// A live sensor without a calibration file: its own comes within seconds.
void wait_for_own_calibration(const std::string& name, Config& config, OpenPackets& open) {
  using Clock = std::chrono::steady_clock;
  StreamSurvey survey(config.hdl64);
  auto next = Clock::now();
  while (is_curious(survey) && !open.packets->all_done()) {
    if (stop_requested()) throw Error(name, "stopped while it waited for the sensor's own calibration");
    for (const Datagram& datagram : open.packets->receive()) survey.add(datagram);
    if (Clock::now() < next) continue;
    next = Clock::now() + std::chrono::seconds(2);
    std::cerr << format("pago: %s: waiting for the sensor's own calibration, %.0f %% of it are there\n",
                        name.c_str(), 100.0 * survey.ingest().status().progress());
  }
  if (survey.ingest().is_refused()) throw Error(name, survey.ingest().refusal());
  take_over(survey, name, config, open);
}

OpenPackets open_live(const std::string& name, Config& config) {
  OpenPackets open;
  open.is_live = true;
  const std::optional<hdl64::Calibration> given = calibration_for({}, config, open.calibration_note);
  auto socket = std::make_unique<UdpSource>(parse_udp_endpoint(name), config.packets, config.udp);
  open.warnings = socket->warnings();
  open.packets = std::move(socket);
  if (given)
    open.calibration = *given;
  else
    wait_for_own_calibration(name, config, open);
  return open;
}

#ifdef PAGO_HAS_SIMULATOR
OpenPackets open_simulated(const std::string& drive, Config& config) {
  simulator::apply_drive_name(config, drive);
  validate(config);
  auto source = std::make_unique<SimulatorSource>(config.simulator, config.hdl64, config.mount);
  OpenPackets open;
  open.calibration = source->calibration();
  open.packets = std::move(source);
  return open;
}
#else
OpenPackets open_simulated(const std::string& drive, Config&) {
  throw Error("sim:" + drive, "this pago was built without the simulator");
}
#endif

/// Scans whose motion is taken out already have one instant only, their middle: settings in run.json say so.
OpenFolder open_folder(const fs::path& path, Config& config) {
  OpenFolder open{
      std::make_unique<KittiSource>(path, config.kitti, SelfFilter(config.vehicle, config.mount))};
  if (open.sweeps->is_compensated()) config.odometry.pose_instant = PoseInstant::kMid;
  return open;
}

bool is_live_name(const std::string& name) {
  return name.starts_with("udp:");
}

OpenSource open(const std::string& name, Config& config) {
  if (const auto drive = after(name, "sim")) return open_simulated(*drive, config);
  if (is_live_name(name)) return open_live(name, config);
  if (const auto file = after(name, "pcap")) return open_capture(*file, config);
  const auto folder = after(name, "kitti");
  if (name.empty() || folder == "")
    throw Error("source", "has no name", "give a capture, a folder or udp://:2368");
  if (fs::path(name).extension() == ".bin")
    throw Error(name, "is a single scan", "name the folder that it lies in");
  std::error_code unknown;
  if (folder || fs::is_directory(name, unknown)) return open_folder(folder.value_or(name), config);
  return open_capture(name, config);
}

}  // namespace

std::optional<hdl64::Calibration> calibration_for(const fs::path& capture,
                                                  Config& config,
                                                  std::string& note) {
  std::string& file = config.hdl64.calibration;
  if (file.empty() && !capture.empty()) {
    // The names under which calibrations are usually kept.
    for (const char* name : {"calibration.xml", "calibration.yaml", "calibration.yml", "db.xml", "db.yaml"}) {
      std::error_code unknown;
      if (!fs::exists(capture.parent_path() / name, unknown)) continue;
      file = (capture.parent_path() / name).string();
      note = file + ", found beside the capture";
      break;
    }
  }
  if (file.empty()) {
    file = kSensorsOwn;
    note = "the sensor's own, from its status bytes";
  }
  if (file == kSensorsOwn) return std::nullopt;
  return hdl64::load_calibration(file, config.hdl64.vertical_offset);
}

void require_labels(const OpenSource& source, const std::string& name, const std::string& method) {
  if (!ground::find_method(method).traits.needs_labels) return;
  std::string unlabelled;
  if (const auto* folder = std::get_if<OpenFolder>(&source)) {
    unlabelled = folder->sweeps->first_without_labels();
  } else if (!std::get<OpenPackets>(source).packets->has_labels()) {
    unlabelled = name;
  }
  if (!unlabelled.empty())
    throw Error(unlabelled, "has no labels, which ground method '" + method + "' needs",
                "choose another method, scans with SemanticKITTI's labels, or a simulated drive");
}

OpenSource open_source(const std::string& name, Config& config) {
  OpenSource source = open(name, config);
  require_labels(source, name, config.ground.method);
  return source;
}

OpenSource open_recording(const std::string& name, Config& config) {
  // Before it is opened: a live sensor's own calibration would be waited for.
  if (is_live_name(name))
    throw Error(name, "is live", "name a recording: a capture, KITTI scans or sim:urban");
  return open_source(name, config);
}

SweepReader reader_of(OpenSource& source, const Config& config) {
  if (OpenPackets* const open = std::get_if<OpenPackets>(&source))
    return {config, *open->packets, open->calibration};
  return {config, *std::get<OpenFolder>(source).sweeps};
}

Progress progress_of(const OpenSource& source) {
  if (const auto* open = std::get_if<OpenPackets>(&source)) return open->packets->progress();
  return std::get<OpenFolder>(source).sweeps->progress();
}

}  // namespace pago::app
