// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pago/config/assembly.hpp"
#include "pago/config/drivers.hpp"
#include "pago/config/features.hpp"
#include "pago/config/ground.hpp"
#include "pago/config/hdl64.hpp"
#include "pago/config/mapping.hpp"
#include "pago/config/mount.hpp"
#include "pago/config/odometry.hpp"
#include "pago/config/output.hpp"
#include "pago/config/pipeline.hpp"
#include "pago/config/preset.hpp"
#include "pago/config/simulator.hpp"
#include "pago/config/vehicle.hpp"

namespace pago {

/// Every setting of PaGO, by module. A default-constructed Config is a working one; change fields directly,
/// or from files and `key=value` words (config/load.hpp). Plain data: copy freely.
struct Config {
  Preset preset = Preset::kDefault;  ///< a name for what was set; apply_preset() sets it
  Mount mount;
  VehicleConfig vehicle;
  PacketFilterConfig packets;
  CaptureConfig capture;
  UdpConfig udp;
  RecordConfig record;
  KittiConfig kitti;
  Hdl64Config hdl64;
  AssemblyConfig assembly;
  GroundConfig ground;
  FeaturesConfig features;
  OdometryConfig odometry;
  MappingConfig mapping;
  PipelineConfig pipeline;
  OutputConfig output;
  PublishConfig publish;
  ControlConfig control;
  SimulatorConfig simulator;
};

template <typename Visitor>
void describe(Visitor& v, Config& c) {
  v("preset", c.preset, preset_choices(), "a named set of settings, which those that follow may change");
  v.section("mount", c.mount, "how the sensor sits on the vehicle");
  v.section("vehicle", c.vehicle, "the vehicle's own body, whose returns are left out");
  v.section("packets", c.packets, "which datagrams of a socket or a capture are the sensor's");
  v.section("capture", c.capture, "which part of a capture is used");
  v.section("udp", c.udp, "how a live sensor's socket is read");
  v.section("record", c.record, "a live sensor's datagrams, kept in captures");
  v.section("kitti", c.kitti, "how a folder of KITTI scans is read");
  v.section("hdl64", c.hdl64, "the sensor: its calibration, and how its packets are read");
  v.section("assembly", c.assembly, "packets into sweeps");
  v.section("ground", c.ground, "which returns the vehicle could stand on");
  v.section("features", c.features, "edges and planar points");
  v.section("odometry", c.odometry, "the motion from one sweep to the next");
  v.section("mapping", c.mapping, "each sweep against the local map: the refined pose");
  v.section("pipeline", c.pipeline, "threads");
  v.section("output", c.output, "what a run leaves behind");
  v.section("publish", c.publish, "poses for other processes, while a live sensor is read");
  v.section("control", c.control, "how a live run is talked to");
  v.section("simulator", c.simulator, "made-up drives: sim:WORLD as the source");
}

}  // namespace pago
