// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// [packets] Which datagrams of a capture or a socket are the sensor's. Everything else is counted as
/// filtered.
struct PacketFilterConfig {
  int port = 2368;
  std::string source_address;
};

template <typename Visitor>
void describe(Visitor& v, PacketFilterConfig& c) {
  v("port", c.port, within(0, 65535), "UDP destination port of the sensor's data; 0 takes every port");
  v("source_address", c.source_address,
    "IPv4 address of the sensor, to tell several apart; empty takes every sender");
}

/// [capture] Which part of a capture is used.
struct CaptureConfig {
  double start_s = 0.0;
  double duration_s = 0.0;
};

template <typename Visitor>
void describe(Visitor& v, CaptureConfig& c) {
  v("start_s", c.start_s, within(0.0, 1e9), "skipped at the beginning, by the capture's own stamps");
  v("duration_s", c.duration_s, within(0.0, 1e9), "used after that; 0: to the end");
}

/// [udp] How a live sensor's socket is read.
struct UdpConfig {
  int receive_buffer_bytes = 4 << 20;
  double drain_interval_ms = 2.0;
};

template <typename Visitor>
void describe(Visitor& v, UdpConfig& c) {
  v("receive_buffer_bytes", c.receive_buffer_bytes, within(4096, 256 << 20),
    "memory asked of the kernel for datagrams that wait; it grants twice as much, which holds 1 s of an "
    "HDL-64E at 4 MiB and 26 ms at the usual default");
  v("drain_interval_ms", c.drain_interval_ms, within(0.1, 20.0),
    "the socket is emptied this often; waking for each packet costs a tenth of a core");
}

/// [record] How a live sensor's datagrams are kept.
struct RecordConfig {
  std::string file;
  int file_mb = 0;
  int keep_files = 0;
  int buffer_mb = 32;
};

template <typename Visitor>
void describe(Visitor& v, RecordConfig& c) {
  v("file", c.file, "capture that a live run's datagrams are written to; empty: none");
  v("file_mb", c.file_mb, within(0, 1'000'000),
    "a file that has this size is closed and the next begun, drive_0001.pcap, drive_0002.pcap and so on; an "
    "HDL-64E sends 260 MB a minute. 0: one file");
  v("keep_files", c.keep_files, within(0, 1'000'000),
    "of those files only so many, the newest, are kept; 0: all");
  v("buffer_mb", c.buffer_mb, within(1, 4096),
    "memory in which datagrams wait for the disk; 32 hold 4 s of an HDL-64E. What finds it full is not "
    "recorded, and counted");
}

/// Whether the returns of a KITTI scan were already brought into the frame of one instant.
enum class KittiCompensation : std::uint8_t {
  kAuto,  ///< by the folder's layout: the odometry benchmark's scans are, raw recordings are not
  kYes,
  kNo
};

/// [kitti] How a folder of KITTI scans is read.
struct KittiConfig {
  KittiCompensation compensated = KittiCompensation::kAuto;
  double vertical_correction_deg = 0.0;
  bool labels = true;
  int first = 0;
  int count = 0;
};

template <typename Visitor>
void describe(Visitor& v, KittiConfig& c) {
  v("compensated", c.compensated,
    choices(std::pair{"auto", KittiCompensation::kAuto}, std::pair{"yes", KittiCompensation::kYes},
            std::pair{"no", KittiCompensation::kNo}),
    "whether scans are free of motion distortion already; auto: odometry layout yes, raw layout no");
  v("vertical_correction_deg", c.vertical_correction_deg, within(-1.0, 1.0),
    "turns every return up by this; 0.205 mends the odometry benchmark's known error, raw data needs none");
  v("labels", c.labels,
    "whether SemanticKITTI's labels are read where there are some: labels/000000.label beside the scans");
  v("first", c.first, within(0, 10000000), "scans skipped at the start of the folder");
  v("count", c.count, within(0, 10000000), "scans read after those; 0 reads all");
}

}  // namespace pago
