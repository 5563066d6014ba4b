// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "source.hpp"

#include <array>
#include <optional>

#include "pago/core/error.hpp"
#include "pago/hdl64/stream_probe.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/udp/udp_source.hpp"

namespace pago::app {

namespace fs = std::filesystem;

namespace {

/// The rest of `name` after `prefix:`, if it starts so.
std::optional<std::string> after(const std::string& name, const std::string& prefix) {
  if (!name.starts_with(prefix + ":")) return std::nullopt;
  return name.substr(prefix.size() + 1);
}

/// A calibration beside the capture, by the names under which they are usually kept.
std::string calibration_beside(const fs::path& capture) {
  for (const char* name : {"calibration.xml", "calibration.yaml", "calibration.yml", "db.xml", "db.yaml"}) {
    const fs::path file = capture.parent_path() / name;
    std::error_code unknown;
    if (fs::exists(file, unknown)) return file.string();
  }
  throw Error(capture.string(), "no calibration given, and none beside the capture",
              "give the unit's own db.xml or yaml with --calibration: without it every range is wrong by "
              "about a metre");
}

/// Looks at the first packets, so that a capture of another sensor, or of none, is refused before anything
/// starts.
void check_sensor(const fs::path& file, const PacketFilterConfig& filter) {
  PcapSource source(file, filter);
  hdl64::StreamProbe probe;
  while (!source.all_done() && !probe.decided()) {
    for (const Datagram& datagram : source.receive()) probe.add(datagram.payload, datagram.arrival_ns);
  }
  if (probe.decided() && !hdl64::is_supported(probe.kind()))
    throw Error(file.string(), hdl64::refusal(probe.kind()));
  const SourceCounters counters = source.counters();
  if (counters.delivered == 0 && counters.bad() > 0) {
    throw Error(
        file.string(), "holds no whole datagram to port " + std::to_string(filter.port),
        std::to_string(counters.truncated) + " are cut short: record with the full length, tcpdump -s 0");
  }
  if (counters.delivered == 0) {
    throw Error(file.string(),
                "holds no datagram to port " + std::to_string(filter.port) +
                    (filter.source_address.empty() ? "" : " from " + filter.source_address),
                std::to_string(counters.filtered) + " others; set packets.port or packets.source_address");
  }
}

OpenPackets open_capture(const fs::path& file, Config& config) {
  std::error_code unknown;
  if (fs::is_fifo(file, unknown))
    throw Error(file.string(), "is a pipe", "captures are read twice: give a file");
  check_sensor(file, config.packets);
  OpenPackets open;
  open.packets = std::make_unique<PcapSource>(file, config.packets);
  if (config.hdl64.calibration.empty()) config.hdl64.calibration = calibration_beside(file);
  open.calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  return open;
}

OpenPackets open_live(const std::string& name, Config& config) {
  if (config.hdl64.calibration.empty())
    throw Error(name, "no calibration given",
                "give the unit's own db.xml or yaml with --calibration: without it every range is wrong by "
                "about a metre");
  OpenPackets open;
  open.is_live = true;
  open.calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  auto socket = std::make_unique<UdpSource>(parse_udp_endpoint(name), config.packets, config.udp);
  open.warnings = socket->warnings();
  open.packets = std::move(socket);
  return open;
}

}  // namespace

OpenSource open_source(const std::string& name, Config& config) {
  if (name.starts_with("udp:")) return open_live(name, config);
  if (const auto file = after(name, "pcap")) return open_capture(*file, config);
  const auto folder = after(name, "kitti");
  std::error_code unknown;
  if (folder || fs::is_directory(name, unknown)) {
    return OpenFolder{std::make_unique<KittiSource>(folder.value_or(name), config.kitti,
                                                    SelfFilter(config.vehicle, config.mount))};
  }
  return open_capture(name, config);
}

}  // namespace pago::app
