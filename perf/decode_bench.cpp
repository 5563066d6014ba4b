// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <bit>
#include <numbers>

#include "pago/hdl64/packet_decoder.hpp"
#include "stage_timer.hpp"
#include "stages.hpp"

namespace pago::perf {

namespace {

/// All returns of a packet, from its first header's azimuth on.
int decode(hdl64::PacketDecoder& decoder, const Datagram& datagram, hdl64::PacketReturns& returns) {
  if (hdl64::check_packet(datagram.payload) != PacketFault::kNone) return 0;
  const hdl64::PacketView packet(datagram.payload.first<hdl64::kPacketBytes>());
  constexpr double kRad_per_cdeg = std::numbers::pi / 18'000.0;
  constexpr double kRate_rad_s = 2.0 * std::numbers::pi * 10.0;
  decoder.decode(packet, {packet.azimuth_cdeg(0) * kRad_per_cdeg, kRate_rad_s}, returns);
  benchmark::DoNotOptimize(&returns);
  benchmark::ClobberMemory();
  return std::popcount(returns.strongest[0].valid);
}

/// As many packets at a time as make a sweep.
void measure_decode(benchmark::State& state, const Drive& drive) {
  const Hdl64Config& config = drive.config.hdl64;
  hdl64::PacketDecoder decoder(drive.calibration, config.min_range_m, config.max_range_m);
  hdl64::PacketReturns returns{};
  StageTimer timer(state, drive);
  const std::size_t batch = drive.datagrams.size() / drive.num_sweeps;
  std::size_t packets = 0;
  std::int64_t size = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t first = packets % (batch * drive.num_sweeps);
    timer.time([&] {
      for (std::size_t i = first; i < first + batch; ++i)
        size += decode(decoder, drive.datagrams[i], returns);
    });
    packets += batch;
  }
  timer.report(packets);
  if (size == 0) state.SkipWithError("no return was decoded");
}

}  // namespace

void register_decode(const Drive& drive) {
  register_per_sweep("check and decode", drive,
                     [&drive](benchmark::State& state) { measure_decode(state, drive); });
}

}  // namespace pago::perf
