// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The simulator against itself: what it casts, sends, and what PaGO makes of it.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "assembly/collector.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "pago/simulator/packet_labels.hpp"
#include "support/catch.hpp"
#include "wall_flatness.hpp"

using namespace pago;
using namespace pago::simulator;
using namespace pago::test;

TEST_CASE("decoded packets agree with the cast geometry to the quantisation", "[simulator][wall]") {
  for (const Label label : {Label::kBuilding, Label::kRoad}) {
    WallScene wall({});
    const Flatness result = flatness(wall, label, true);
    INFO("label " << static_cast<int>(label) << ", " << result.count << " returns");
    REQUIRE(result.count > 5000);
    // Half a step, and what single precision adds.
    CHECK(result.worst_steps < 0.65);
  }
}

TEST_CASE("a wall seen from a turning, moving sensor is flat after exact de-skew and smeared before",
          "[simulator][wall]") {
  WallScene moving({});
  CHECK(flatness(moving, Label::kBuilding, true).rms_m < 0.001);
  WallScene again({});
  CHECK(flatness(again, Label::kBuilding, false).rms_m > 0.3);
}

TEST_CASE("range noise is what it is set to", "[simulator][wall]") {
  WallScene noisy({.noise_m = 0.02});
  std::vector<double> offsets;
  decode_all(noisy, [&](const Eigen::Vector3d& point, double t_s, Label label) {
    const Eigen::Isometry3d T = noisy.sensor.T_world_sensor(t_s);
    const Eigen::Vector3d beam = (T.linear() * point).normalized();
    if (label == Label::kBuilding && beam.x() > 0.95)
      offsets.push_back(((T * point).x() - WallScene::kWall_m) / beam.x());
  });
  REQUIRE(offsets.size() > 2000);
  double sum = 0.0, squares = 0.0;
  for (const double off : offsets) sum += off, squares += off * off;
  const auto n = static_cast<double>(offsets.size());
  CHECK(std::abs(sum / n) < 0.002);
  CHECK(std::sqrt(squares / n) == Approx(0.02).epsilon(0.05));
}

TEST_CASE("the same seed gives the same bytes, whatever was rendered before", "[simulator][wall]") {
  WallScene first({.noise_m = 0.02, .packets = 40}), second({.noise_m = 0.02, .packets = 40});
  std::vector<FiringSlots> unrelated(Sensor::kBlock);
  second.sensor.fire(4800, second.scene, second.traffic, std::span<FiringSlots, Sensor::kBlock>(unrelated));
  const auto a = first.packets(), b = second.packets();
  REQUIRE(a.size() == b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    REQUIRE(a[i].bytes == b[i].bytes);
    REQUIRE(a[i].labels == b[i].labels);
    REQUIRE(a[i].arrival_ns == b[i].arrival_ns);
  }
}

TEST_CASE("packets are well-formed, with whole encoder steps and steady stamps", "[simulator][wall]") {
  WallScene wall({.packets = 100});
  const auto packets = wall.packets();
  int last_steps = -1;
  for (std::size_t i = 0; i < packets.size(); ++i) {
    REQUIRE(hdl64::check_packet(packets[i].bytes) == PacketFault::kNone);
    const hdl64::PacketView view(packets[i].bytes);
    REQUIRE(view.stamp_us() ==
            (WallScene::kStart_ns / 1000 + 288 * static_cast<std::int64_t>(i)) % 3'600'000'000);
    REQUIRE(packets[i].arrival_ns > packets[i].time_ns + hdl64::kPacketPeriod_ns);
    for (int firing = 0; firing < hdl64::kFirings; ++firing) {
      REQUIRE(view.azimuth_cdeg(firing) % 9 == 0);
      const int steps = view.azimuth_cdeg(firing) / 9;
      if (last_steps >= 0) REQUIRE((steps - last_steps >= 1 && steps - last_steps <= 2));
      last_steps = steps;
    }
  }
  REQUIRE(hdl64::PacketView(packets[0].bytes).azimuth_cdeg(0) == 18000);
}

TEST_CASE("PaGO assembles the packets to whole sweeps, and every return finds its class again",
          "[simulator][wall]") {
  WallScene wall({});
  const hdl64::Calibration unit = made_up_unit();
  LabelTrack labels(1000, hdl64::kFiringPeriod_ns, hdl64::kFirings);
  Collector collector;
  double worst_m = 0.0;
  collector.on_part = [&](const SweepPart& part) {
    Sweep& sweep = *part.sweep;
    REQUIRE(labels.label(sweep, unit) == sweep.size);
    REQUIRE(sweep.header.has(kLabelled));
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const auto label = static_cast<Label>(sweep.label[i]);
      REQUIRE((label == Label::kBuilding || label == Label::kRoad));
      const double t_s =
          static_cast<double>(sweep.header.start_ns + sweep.time_offset_ns[i] - WallScene::kStart_ns) * 1e-9;
      const Eigen::Vector3d p = wall.sensor.T_world_sensor(t_s) *
                                Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>();
      worst_m = std::max(worst_m, std::abs(label == Label::kBuilding ? p.x() - WallScene::kWall_m : p.z()));
    }
  };
  PacketIngest ingest(AssemblyConfig{}, Hdl64Config{}, unit, collector);
  const auto packets = wall.packets();
  for (const SimulatedPacket& packet : packets) {
    labels.add(packet);
    ingest.push({.payload = packet.bytes, .arrival_ns = packet.arrival_ns});
  }
  ingest.finish();
  CHECK(ingest.packets().decoded == packets.size());
  CHECK(ingest.packets().bad_total() == 0);
  CHECK(ingest.firings().lost == 0);
  REQUIRE(collector.sweeps.size() >= 2);
  // PaGO's own azimuth is good to 0.01 degrees: 14 mm at 80 m.
  CHECK(worst_m < 0.02);
}
