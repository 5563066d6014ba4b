// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Status bytes. The input is a program: four bytes are an instruction, which sends so many packets of a true
// sensor's round, or one with bytes of the input.
#include <cmath>

#include "fuzz/fuzz.hpp"
#include "pago/hdl64/status_reader.hpp"
#include "support/status_cycle.hpp"

using namespace pago;

namespace {

constexpr std::size_t kMostPackets = 3 * hdl64::StatusReader::kRoundPackets;

const test::StatusCycle& sensor(bool is_s3) {
  static const auto make = [](bool s3) {
    hdl64::Calibration unit;
    for (std::size_t i = 0; i < unit.lasers.size(); ++i) {
      unit.lasers[i].vertical_rad = (static_cast<double>(i) - 50.0) * 0.007;
      unit.lasers[i].distance_m = unit.lasers[i].distance_x_m = unit.lasers[i].distance_y_m = 1.2;
      unit.lasers[i].max_intensity = 255;
    }
    return test::make_status_cycle(unit, {.is_s3 = s3});
  };
  static const test::StatusCycle s3 = make(true), s2 = make(false);
  return is_s3 ? s3 : s2;
}

void check(const hdl64::StatusReader& reader) {
  fuzz::require(reader.progress() >= 0.0 && reader.progress() <= 1.0);
  const auto calibration = reader.calibration(VerticalOffset::kVertical);
  fuzz::require(calibration.has_value() == reader.has_calibration());
  if (!calibration) return;
  for (const auto& laser : calibration->lasers)
    fuzz::require(std::abs(laser.vertical_rad) < 1.6 && std::isfinite(laser.distance_m));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static hdl64::StatusReader reader;
  reader = {};
  std::size_t at = 0;
  for (std::size_t i = 0; i + 4 <= size && at < kMostPackets; i += 4) {
    const std::uint8_t* const word = data + i;
    if (word[0] % 4 == 0) {
      reader.add(word[1], word[2], word[3]);
      ++at;
    } else if (word[0] == 255) {
      reader.lose_place();
      ++at;
    } else {
      const std::size_t count = word[1] * 24U, missing = word[2];
      at += missing;
      for (std::size_t k = 0; k < count; ++k, ++at) {
        const test::StatusByte& byte = sensor(word[3] % 2 == 0)[at % test::StatusCycle{}.size()];
        reader.add(byte.type, byte.value, k == 0 ? static_cast<std::int64_t>(missing) + 1 : 1);
      }
    }
  }
  check(reader);
  return 0;
}
