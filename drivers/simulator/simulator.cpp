// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/simulator.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "packet_stream.hpp"
#include "pago/core/units.hpp"
#include "pago/simulator/unit.hpp"
#include "presets.hpp"
#include "surroundings.hpp"

namespace pago::simulator {
namespace {

/// 2026-03-02 10:15:00 UTC.
constexpr std::int64_t kStart_ns = 1'772'446'500'000'000'000;
constexpr std::int64_t kStampWrap_ns = 3'600'000'000'000;

bool is_s3(const SimulatorConfig& config) {
  return config.unit != SimulatedUnit::kS2;
}
bool is_dual(const SimulatorConfig& config) {
  return config.unit == SimulatedUnit::kS3Dual;
}

/// What the unit says of itself: 0 strongest, 2 both.
int return_mode(const SimulatorConfig& config) {
  return is_dual(config) ? 2 : 0;
}

FiringTiming timing_of(const SimulatorConfig& config) {
  if (is_dual(config)) return kDualReturn;
  return is_s3(config) ? kSingleReturnS3 : kSingleReturn;
}

std::int64_t start_of(const SimulatorFaults& faults) {
  if (faults.hour_ends_at_s <= 0.0) return kStart_ns;
  return (kStart_ns / kStampWrap_ns + 1) * kStampWrap_ns - std::llround(faults.hour_ends_at_s * 1e9);
}

hdl64::Calibration calibration_file(const Hdl64Config& sensor) {
  if (!sensor.calibration.empty()) return hdl64::load_calibration(sensor.calibration, sensor.vertical_offset);
  hdl64::Calibration unit = made_up_unit();
  unit.vertical_offset = sensor.vertical_offset;
  return unit;
}

SensorSetup sensor_setup(const SimulatorConfig& config, const hdl64::Calibration& file, const Mount& mount) {
  const auto seed = static_cast<std::uint64_t>(config.seed);
  const UnitErrors errors{config.range_bias_m, config.angle_error_deg * kDegree};
  return {.unit = imperfect(file, errors, seed),
          .timing = timing_of(config),
          .rotation_hz = config.rotation_hz,
          .head_stops_at_s = config.faults.head_stops_at_s,
          .returns = {config.range_noise_m, config.outliers, config.wetness},
          .T_base_sensor = mount.T_base_sensor(),
          .has_uneven_ground = preset_of(config.world).has_uneven_streets,
          .seed = seed};
}

/// As many rotations as are asked for, or as the drive is long.
std::uint64_t whole_sweeps(const SimulatorConfig& config, const Sensor& sensor, double drive_s) {
  auto count = static_cast<std::uint64_t>(std::max(1LL, std::llround(config.seconds * config.rotation_hz)));
  const auto end_s = [&] { return sensor.head().time_at_s(Head::kStart_rev + static_cast<double>(count)); };
  while (count > 1 && end_s() > drive_s) --count;
  return count;
}

/// Enough to complete the last rotation.
std::uint64_t packets_of(const Sensor& sensor, std::uint64_t num_sweeps) {
  const double end_s = sensor.head().time_at_s(Head::kStart_rev + static_cast<double>(num_sweeps));
  return static_cast<std::uint64_t>(end_s * 1e9 / static_cast<double>(sensor.timing().packet_period_ns())) +
         1;
}

}  // namespace

struct Simulator::State {
  State(const SimulatorConfig& config, const Hdl64Config& sensor_config, const Mount& mount)
      : start_ns(start_of(config.faults)),
        file(calibration_file(sensor_config)),
        surroundings(lay_out(config)),
        scene([this](const Tile& tile) { return surroundings.world->tile(tile); }),
        sensor(sensor_setup(config, file, mount), *surroundings.T_world_base),
        num_sweeps(whole_sweeps(config, sensor, surroundings.T_world_base->duration_s())),
        num_packets(packets_of(sensor, num_sweeps)),
        stream(sensor,
               scene,
               *surroundings.traffic,
               StatusCycle(file, config.rotation_hz, is_s3(config), return_mode(config)),
               {sensor_config.packet_stamp, start_ns, num_packets, static_cast<std::uint64_t>(config.seed)}) {
  }

  double seconds(std::int64_t time_ns) const { return static_cast<double>(time_ns - start_ns) * 1e-9; }

  std::int64_t start_ns;
  hdl64::Calibration file;
  Surroundings surroundings;
  RayCaster scene;
  Sensor sensor;
  std::uint64_t num_sweeps, num_packets;
  PacketStream stream;
};

Simulator::Simulator(const SimulatorConfig& config, const Hdl64Config& sensor, const Mount& mount)
    : state_(std::make_unique<State>(config, sensor, mount)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

bool Simulator::next(SimulatedPacket& packet) {
  return state_->stream.next(packet);
}

void Simulator::skip_to(std::int64_t time_ns) noexcept {
  const std::int64_t since_ns = std::max(std::int64_t{0}, time_ns - state_->start_ns);
  state_->stream.skip_to(static_cast<std::uint64_t>(since_ns / state_->sensor.timing().packet_period_ns()));
}

const hdl64::Calibration& Simulator::calibration() const noexcept {
  return state_->file;
}
hdl64::StreamFormat Simulator::format() const noexcept {
  const FiringTiming& timing = state_->sensor.timing();
  const bool is_dual = timing.firings == kDualReturn.firings;
  return {is_dual ? hdl64::SensorKind::kHdl64Dual : hdl64::SensorKind::kHdl64Single, timing.period_ns};
}
std::int64_t Simulator::start_ns() const noexcept {
  return state_->start_ns;
}
std::int64_t Simulator::duration_ns() const noexcept {
  return static_cast<std::int64_t>(state_->num_packets) * state_->sensor.timing().packet_period_ns();
}
std::uint64_t Simulator::num_packets() const noexcept {
  return state_->num_packets;
}
std::uint64_t Simulator::num_sweeps() const noexcept {
  return state_->num_sweeps;
}
std::uint64_t Simulator::sweeps_until(std::int64_t time_ns) const noexcept {
  return std::min(state_->num_sweeps, static_cast<std::uint64_t>(revolutions(time_ns) - Head::kStart_rev));
}
SweepTimes Simulator::sweep(std::uint64_t index) const noexcept {
  const auto at = [&](double turn) {
    const double t_s = state_->sensor.head().time_at_s(Head::kStart_rev + static_cast<double>(index) + turn);
    return state_->start_ns + std::llround(t_s * 1e9);
  };
  return {at(0.0), at(0.5), at(1.0)};
}
Eigen::Isometry3d Simulator::T_world_sensor(std::int64_t time_ns) const noexcept {
  return state_->sensor.T_world_sensor(state_->seconds(time_ns));
}
double Simulator::revolutions(std::int64_t time_ns) const noexcept {
  return state_->sensor.head().revolutions(state_->seconds(time_ns));
}

}  // namespace pago::simulator
