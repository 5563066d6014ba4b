// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "pago/config/describe.hpp"

namespace pago {

/// Whose pose others get.
enum class PoseChild { kBaseLink, kSensor };

/// [publish] Poses for other processes, while a live sensor is read.
struct PublishConfig {
  PoseChild child = PoseChild::kBaseLink;
  std::string shared_memory = "pago";
  std::string udp;
  std::string json_lines;
};

template <typename Visitor>
void describe(Visitor& v, PublishConfig& c) {
  v("child", c.child,
    choices(std::pair{"base_link", PoseChild::kBaseLink}, std::pair{"sensor", PoseChild::kSensor}),
    "whose pose is published: of the vehicle's base_link, through the mount, or of the sensor");
  v("shared_memory", c.shared_memory,
    "the newest first and refined pose in /dev/shm under this name (pago/output/pose_v1.h); empty: not "
    "there");
  v("udp", c.udp, "address:port that gets each pose as a datagram (pago/output/pose_v1.h); empty: none");
  v("json_lines", c.json_lines,
    "file that gets each refined pose as a line of JSON; - is the terminal; empty: none");
}

/// [control]
struct ControlConfig {
  std::string socket;
};

template <typename Visitor>
void describe(Visitor& v, ControlConfig& c) {
  v("socket", c.socket,
    "Unix socket by which `pago ctl` talks to this run; empty: the user's usual one; none: not at all");
}

/// [output.map] The map that a run leaves: map.ply.
struct SavedMapConfig {
  bool save = true;
  double voxel_m = 0.1;
  int max_points_in_memory = 2'000'000;
};

template <typename Visitor>
void describe(Visitor& v, SavedMapConfig& c) {
  v("save", c.save, "whether there is one");
  v("voxel_m", c.voxel_m, within(0.01, 10.0), "it has one point in each cube of this side");
  v("max_points_in_memory", c.max_points_in_memory, within(10'000, 1'000'000'000),
    "beyond, places that were not seen for longest wait on the disk; about 70 bytes each");
}

/// [output]
struct OutputConfig {
  SavedMapConfig map;
  std::string folder = "results";
  double flush_interval_s = 1.0;
  int trace_sweeps = 300;
};

template <typename Visitor>
void describe(Visitor& v, OutputConfig& c) {
  v.section("map", c.map, "the map that a run leaves: map.ply");
  v("folder", c.folder, "each run makes a folder of its own in this one");
  v("flush_interval_s", c.flush_interval_s, within(0.0, 3600.0),
    "poses reach the disk at least this often; 0: each at once");
  v("trace_sweeps", c.trace_sweeps, within(0, 100000),
    "sweeps that trace.json shows, the last of the run; 0: no trace");
}

}  // namespace pago
