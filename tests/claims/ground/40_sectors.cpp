// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Masks of sweeps that are segmented while they arrive, in 2 to 72 sectors, against those of whole sweeps:
// every sweep of the drive, a drive through rough country from a simulator that is not ours, and a rough test
// scene, level and for a tilted sensor.
#include <algorithm>
#include <vector>

#include "tests/claims/report.hpp"
#include "tests/ground/sectors.hpp"
#include "tests/support/recorded_sweeps.hpp"
#include "tests/support/scene.hpp"

using namespace pago;
using claims::Report;
using test::SectorWatch;

namespace {

constexpr int kMinSectors = 2, kMaxSectors = 72;
constexpr double kLeastParts_percent = 90.0;

/// The methods that work on parts: by polar bins, and on the range image. The others wait for the sweep's
/// end.
std::vector<test::GroundCase> cases() {
  std::vector<test::GroundCase> result;
  for (const test::GroundCase& c : test::ground_cases())
    for (const char* name : {"patchwork", "patchwork-hdl64", "patchworkpp", "rgpf", "lego", "linefit"})
      if (c.name == name) result.push_back(c);
  return result;
}

/// How many parts whole sweeps come in, of as many as there are sectors. The last of them may be missing:
/// what the lasers that look ahead hit belongs to columns that are not closed yet.
class PartCount {
 public:
  explicit PartCount(int sectors) : sectors_(sectors) {}

  void take(const SweepPart& part) {
    ++parts_;
    if (!part.last) return;
    if (part.sweep->header.is_posed()) fewest_ = std::min(fewest_, parts_);
    parts_ = 0;
  }
  double least_percent() const { return 100.0 * fewest_ / sectors_; }

 private:
  int sectors_, fewest_ = kMaxSectors, parts_ = 0;
};

void report(Report& out, const std::string& where, std::uint64_t sweeps, std::uint64_t expected, long wrong) {
  out.exactly("ground sectors: masks compared for each of the methods, " + where, sweeps, expected);
  out.exactly("ground sectors: returns whose mask differs, " + where, static_cast<std::uint64_t>(wrong), 0);
}

/// Every rotation of a capture, the parts of one at either end included, assembled in each number of sectors.
void on_capture(Report& out, const std::string& capture, const std::string& calibration) {
  const auto assemble = [&](int sectors, const auto& take) {
    test::RecordedSweeps drive(claims::recording(capture), claims::recording(calibration), sectors, take);
    while (drive.next() != nullptr) {
    }
  };
  std::uint64_t num_rotations = 0;
  assemble(1, [&](const SweepPart& part) { num_rotations += part.last ? 1U : 0U; });
  SectorWatch watch(cases(), Mount{});
  watch.repeat();
  double least_percent = 100.0;
  for (int sectors = kMinSectors; sectors <= kMaxSectors; ++sectors) {
    watch.begin_anew();
    PartCount count(sectors);
    assemble(sectors, [&](const SweepPart& part) { count.take(part), watch.take(part); });
    least_percent = std::min(least_percent, count.least_percent());
  }
  const std::string where = capture.substr(0, capture.rfind('/')).substr(std::string("packets/").size());
  report(out, where, static_cast<std::uint64_t>(watch.sweeps()),
         num_rotations * (kMaxSectors - kMinSectors + 1), watch.different());
  out.at_least("ground sectors: parts that whole sweeps came in, of their sectors, " + where, least_percent,
               kLeastParts_percent, " %");
}

void on_rough_scene(Report& out) {
  Sweep sweep(test::kMaxReturns);
  std::uint64_t compared = 0;
  long wrong = 0;
  for (const Mount& mount : {Mount{}, Mount{.roll_rad = -0.1, .pitch_rad = 0.15}}) {
    test::Scene()
        .ground(0.06, 0.03)
        .bumps(0.25, 7.0)
        .bumps(0.08, 1.3)
        .box({-40, 14, -3}, {40, 15, 5})
        .scan(sweep, {.mount = mount, .noise_m = 0.02});
    SectorWatch watch(cases(), mount);
    for (int sectors = kMinSectors; sectors <= kMaxSectors; ++sectors) {
      for (int k = 1; k < sectors; ++k) watch.take(test::part_of(sweep, static_cast<double>(k) / sectors));
      watch.take({&sweep, sweep.size, sweep.header.num_columns, true});
    }
    compared += static_cast<std::uint64_t>(watch.sweeps());
    wrong += watch.different();
  }
  report(out, "rough scene", compared, 2 * (kMaxSectors - kMinSectors + 1), wrong);
}

}  // namespace

int main() {
  return claims::run("ground sectors", [](Report& out) {
    on_rough_scene(out);
    on_capture(out, "packets/lab_rural/packets.pcap", "packets/lab_rural/calibration.xml");
    on_capture(out, "packets/drive_0005/drive_0005.pcap", "packets/drive_0005/calibration.yaml");
  });
}
