// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/simulator_source.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "assembly/collector.hpp"
#include "drivers/simulator/surface.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "pago/config/config.hpp"
#include "pago/core/error.hpp"
#include "pago/simulator/drive_name.hpp"
#include "support/catch.hpp"

using namespace pago;
using simulator::Label;

namespace {

SimulatorConfig drive(double seconds) {
  SimulatorConfig config;
  config.seconds = seconds;
  config.start_speed_m_s = 10.0;
  return config;
}

}  // namespace

TEST_CASE("a simulated drive goes through PaGO's packet side without a loss", "[simulator][source]") {
  SimulatorSource source(drive(0.3), {}, {});
  const hdl64::Calibration unit = source.calibration();
  std::map<Label, std::size_t> classes;
  std::uint64_t returns = 0, unknown = 0;
  double ground_off_m = 0.0;
  test::Collector collector;
  collector.on_part = [&](const SweepPart& part) {
    Sweep& sweep = *part.sweep;
    if (!sweep.header.is_posed()) return;
    unknown += sweep.size - source.labels().label(sweep, unit);
    returns += sweep.size;
    const Eigen::Isometry3d T_mid = source.drive().T_world_sensor(sweep.header.start_ns + 50'000'000);
    std::vector<double> heights;
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      const auto label = static_cast<Label>(sweep.label[i]);
      ++classes[label];
      const Eigen::Isometry3d T =
          source.drive().T_world_sensor(sweep.header.start_ns + sweep.time_offset_ns[i]);
      const Eigen::Vector3d p = T * Eigen::Vector3f(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]).cast<double>();
      const bool is_near = (p - T_mid.translation()).head<2>().norm() < 6.0;
      if (label == Label::kRoad && is_near) heights.push_back((T_mid.inverse() * p).z());
    }
    std::ranges::nth_element(heights, heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2));
    ground_off_m = std::max(ground_off_m, std::abs(heights[heights.size() / 2] + 1.73));
  };
  PacketIngest ingest(AssemblyConfig{}, Hdl64Config{}, unit, collector);
  while (!source.all_done())
    for (const Datagram& datagram : source.receive()) ingest.push(datagram);
  ingest.finish();
  CHECK(source.complaint().empty());
  CHECK(source.counters().balanced());
  CHECK(ingest.packets().decoded == source.drive().num_packets());
  CHECK(ingest.packets().bad_total() == 0);
  CHECK(ingest.firings().lost == 0);
  REQUIRE(source.drive().num_sweeps() == 3);
  CHECK(unknown == 0);
  CHECK(static_cast<double>(returns) / 3.0 > 110'000);
  CHECK(static_cast<double>(returns) / 3.0 < 130'000);
  CHECK(classes[Label::kUnlabelled] == 0);
  const auto share = [&](Label label) {
    return static_cast<double>(classes[label]) / static_cast<double>(returns);
  };
  CHECK(share(Label::kRoad) > 0.2);
  CHECK(share(Label::kBuilding) + share(Label::kVegetation) > 0.1);
  CHECK(ground_off_m < 0.1);
}

TEST_CASE("an S3's single and dual returns go through PaGO's packet side", "[simulator][source]") {
  const auto [unit, kind, period_ns] = GENERATE(table<SimulatedUnit, hdl64::SensorKind, std::int64_t>(
      {{SimulatedUnit::kS3, hdl64::SensorKind::kHdl64Single, hdl64::kFiringPeriodS3_ns},
       {SimulatedUnit::kS3Dual, hdl64::SensorKind::kHdl64Dual, hdl64::kFiringPeriodS3_ns}}));
  SimulatorConfig config = drive(0.3);
  config.unit = unit;
  SimulatorSource source(config, {}, {});
  CHECK(source.drive().format() == hdl64::StreamFormat{kind, period_ns});
  std::uint64_t returns = 0, unknown = 0, second = 0;
  test::Collector collector;
  collector.allows_echoes = unit == SimulatedUnit::kS3Dual;
  collector.on_part = [&](const SweepPart& part) {
    Sweep& sweep = *part.sweep;
    if (!sweep.header.is_posed()) return;
    unknown += sweep.size - source.labels().label(sweep, source.calibration());
    returns += sweep.size;
  };
  PacketIngest ingest(AssemblyConfig{}, Hdl64Config{}, source.calibration(), collector);
  while (!source.all_done()) {
    for (const Datagram& datagram : source.receive()) {
      REQUIRE(hdl64::check_packet(datagram.payload, source.drive().format()) == PacketFault::kNone);
      // A second return is another distance for the same laser in blocks 2 and 3.
      for (std::size_t at = 4; at < hdl64::kBlockBytes; at += 3)
        if (unit == SimulatedUnit::kS3Dual &&
            datagram.payload[at] != datagram.payload[2 * hdl64::kBlockBytes + at])
          ++second;
      ingest.push(datagram);
    }
  }
  ingest.finish();
  CHECK(ingest.packets().bad_total() == 0);
  CHECK(unknown == 0);
  CHECK(static_cast<double>(returns) / 3.0 > 85'000);
  if (unit == SimulatedUnit::kS3Dual) CHECK(second > 1000);
}

TEST_CASE("the same settings give the same packets, another seed others", "[simulator][source]") {
  const auto first_packet = [](int seed) {
    SimulatorConfig config = drive(0.1);
    config.seed = seed;
    simulator::Simulator simulator(config, {}, {});
    simulator::SimulatedPacket packet;
    REQUIRE(simulator.next(packet));
    return packet;
  };
  const simulator::SimulatedPacket a = first_packet(1), b = first_packet(1), c = first_packet(2);
  CHECK(a.bytes == b.bytes);
  CHECK(a.labels == b.labels);
  CHECK(a.bytes != c.bytes);
}

TEST_CASE("sweeps' times are those of the head", "[simulator][source]") {
  const simulator::Simulator simulator(drive(0.5), {}, {});
  REQUIRE(simulator.num_sweeps() == 5);
  for (std::uint64_t i = 0; i < 5; ++i) {
    const simulator::SweepTimes sweep = simulator.sweep(i);
    CHECK(simulator.revolutions(sweep.start_ns) == Approx(0.5 + static_cast<double>(i)));
    CHECK(simulator.revolutions(sweep.mid_ns) == Approx(1.0 + static_cast<double>(i)));
    CHECK(simulator.sweep(i + 1).start_ns == sweep.end_ns);
  }
  CHECK(simulator.sweep(4).end_ns <= simulator.start_ns() + simulator.duration_ns());
}

TEST_CASE("a mount turns the sensor on the vehicle", "[simulator][source]") {
  Mount tilted;
  tilted.pitch_rad = 0.17;
  tilted.height_m = 2.0;
  const simulator::Simulator level(drive(0.2), {}, {}), leaning(drive(0.2), {}, tilted);
  const Eigen::Isometry3d T =
      level.T_world_sensor(level.start_ns()).inverse() * leaning.T_world_sensor(level.start_ns());
  CHECK(T.translation().z() == Approx(0.27));
  CHECK(Eigen::AngleAxisd(T.linear()).angle() == Approx(0.17));
}

TEST_CASE("a drive's name sets the simulator's settings and is checked", "[simulator][source]") {
  Config config;
  simulator::apply_drive_name(config, "urban,seed=7,seconds=3.5");
  CHECK(config.simulator.seed == 7);
  CHECK(config.simulator.seconds == 3.5);
  simulator::apply_drive_name(config, "urban");
  CHECK(config.simulator.seed == 7);
  REQUIRE_THROWS_WITH(simulator::apply_drive_name(config, "moon"), Catch::Contains("simulator.world"));
  REQUIRE_THROWS_WITH(simulator::apply_drive_name(config, ""), Catch::Contains("simulator.world"));
  REQUIRE_THROWS_WITH(simulator::apply_drive_name(config, "urban,sed=3"), Catch::Contains("simulator.seed"));
  REQUIRE_THROWS_AS(simulator::apply_drive_name(config, "urban,seconds=-1"), Error);
}

TEST_CASE("a calibration file that is not there is named", "[simulator][source]") {
  Hdl64Config sensor;
  sensor.calibration = "missing.xml";
  REQUIRE_THROWS_WITH(SimulatorSource(drive(1.0), sensor, {}), Catch::Contains("missing.xml"));
}
