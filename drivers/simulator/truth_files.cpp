// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "truth_files.hpp"

#include <array>
#include <string>

#include "pago/core/text.hpp"
#include "pago/output/text_file.hpp"
#include "pago/output/trajectory_writer.hpp"

namespace pago::simulator {

void write_truth(const Simulator& drive,
                 std::uint64_t num_sweeps,
                 std::int64_t until_ns,
                 const std::filesystem::path& tum) {
  constexpr std::int64_t kInterval_ns = 5'000'000;
  constexpr std::array<std::int64_t SweepTimes::*, 3> kInstants{&SweepTimes::start_ns, &SweepTimes::mid_ns,
                                                                &SweepTimes::end_ns};
  constexpr std::array<const char*, 3> kNames{"_start.txt", "_mid.txt", "_end.txt"};
  const auto row = [&](std::int64_t time_ns) { return output::to_row(drive.T_world_sensor(time_ns)); };
  std::string poses;
  for (std::int64_t t_ns = drive.start_ns(); t_ns <= until_ns; t_ns += kInterval_ns)
    poses += output::tum_line(t_ns, row(t_ns));
  output::write_file(tum, poses);

  const std::string stem = (tum.parent_path() / tum.stem()).string();
  for (std::size_t instant = 0; instant < kInstants.size(); ++instant) {
    std::string rows;
    for (std::uint64_t i = 0; i < num_sweeps; ++i)
      rows += output::kitti_line(row(drive.sweep(i).*kInstants[instant]));
    output::write_file(stem + kNames[instant], rows);
  }
  std::string times;
  for (std::uint64_t i = 0; i < num_sweeps; ++i) {
    const SweepTimes sweep = drive.sweep(i);
    for (const auto instant : kInstants) {
      const std::int64_t t_ns = sweep.*instant;
      times += format("%lld.%09lld%c", static_cast<long long>(t_ns / 1'000'000'000),
                      static_cast<long long>(t_ns % 1'000'000'000), instant == kInstants.back() ? '\n' : ' ');
    }
  }
  output::write_file(stem + "_times.txt", times);
}

}  // namespace pago::simulator
