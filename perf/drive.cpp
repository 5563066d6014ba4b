// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drive.hpp"

#include <cstdlib>
#include <filesystem>

#include "pago/core/error.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "sweep_feed.hpp"

namespace pago::perf {

namespace fs = std::filesystem;

namespace {

void read_packets(const fs::path& capture, Drive& drive) {
  PcapSource source(capture, drive.config.packets);
  drive.bytes.reserve(fs::file_size(capture));  // never moves, so payloads may point into it
  while (!source.all_done()) {
    for (Datagram datagram : source.receive()) {
      const std::size_t begin = drive.bytes.size();
      drive.bytes.insert(drive.bytes.end(), datagram.payload.begin(), datagram.payload.end());
      datagram.payload = std::span(drive.bytes).subspan(begin);
      drive.datagrams.push_back(datagram);
    }
  }
  if (!source.complaint().empty()) throw Error(capture.string(), source.complaint());
}

/// What the assembler writes per return (x, y, z, intensity, ring, column, time), and the range image.
std::size_t bytes_of(const Sweep& sweep) {
  const std::size_t per_return =
      3 * sizeof(float) + 2 * sizeof(std::uint8_t) + sizeof(std::uint16_t) + sizeof(std::int32_t);
  return sweep.size * per_return + kNumRings * sweep.header.num_columns * sizeof(std::int32_t);
}

void survey(Drive& drive) {
  SweepFeed feed(drive);
  std::size_t total = 0;
  while (const Sweep* sweep = feed.next()) {
    total += bytes_of(*sweep);
    ++drive.num_sweeps;
  }
  if (drive.num_sweeps == 0) throw Error("drive_0005.pcap", "no sweep in it", feed.refusal());
  drive.sweep_bytes = total / drive.num_sweeps;
}

}  // namespace

std::optional<Drive> load_drive() {
  const char* data = std::getenv("PAGO_DATA");
  const fs::path folder = fs::path(data == nullptr ? "" : data) / "packets" / "drive_0005";
  if (data == nullptr || !fs::exists(folder / "drive_0005.pcap")) return std::nullopt;
  Drive drive;
  drive.config.hdl64.calibration = (folder / "calibration.yaml").string();
  drive.calibration =
      hdl64::load_calibration(drive.config.hdl64.calibration, drive.config.hdl64.vertical_offset);
  read_packets(folder / "drive_0005.pcap", drive);
  survey(drive);
  return drive;
}

}  // namespace pago::perf
