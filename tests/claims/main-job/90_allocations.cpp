// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// The whole pipeline on the drive, every call to the heap counted by thread (tests/support/alloc_guard.hpp):
// once as it is, and once with an allocation planted on each of its threads, which must be found.
#include <array>
#include <atomic>
#include <cstring>
#include <ctime>

#include "pago/pcap/pcap_source.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "pago/platform/thread.hpp"
#include "support/alloc_guard.hpp"
#include "tests/claims/report.hpp"

using namespace pago;
using claims::Report;
using test::RealtimeThreads;

namespace {

constexpr std::uint64_t kWarmUp_sweeps = 20;
constexpr std::uint64_t kMeasured_sweeps = 120;  // the stream's end, where threads wind up, stays out
constexpr std::uint64_t kMaxHeapCalls = 0;
constexpr std::uint64_t kPlanted = 2;  // one new, one delete

/// The names that the pipeline gives its threads.
constexpr std::array<const char*, 3> kThreads{"ingest", "front", "estimate"};

/// Whether a thread's next reading of its own CPU time, of which every stage of every sweep makes some, shall
/// allocate.
std::array<std::atomic<bool>, kThreads.size()> is_planted{};

void allocate_if_planted() noexcept {
  for (std::size_t i = 0; i < kThreads.size(); ++i) {
    if (std::strcmp(platform::current_thread_name(), kThreads[i]) != 0) continue;
    if (!is_planted[i].exchange(false)) continue;
    int* volatile const planted = new int;
    delete planted;
  }
}

/// Arms the guard after the warm-up and disarms it before the end.
class Guarding final : public Observer {
 public:
  explicit Guarding(bool plants) : plants_(plants) {}

  void on_sweep(const output::SweepRecord&) override {
    ++sweeps_;
    if (sweeps_ == kWarmUp_sweeps) {
      RealtimeThreads::arm({kThreads[0], kThreads[1], kThreads[2]});
      for (auto& planted : is_planted) planted = plants_;
    }
    if (sweeps_ == kWarmUp_sweeps + kMeasured_sweeps) RealtimeThreads::disarm();
  }
  bool is_over() const { return sweeps_ >= kWarmUp_sweeps + kMeasured_sweeps; }

 private:
  bool plants_;
  std::uint64_t sweeps_ = 0;
};

void run_drive(bool plants) {
  PcapSource source(claims::recording("packets/drive_0005/drive_0005.pcap"));
  Config config;
  config.hdl64.calibration = claims::recording("packets/drive_0005/calibration.yaml").string();
  const auto calibration = hdl64::load_calibration(config.hdl64.calibration, config.hdl64.vertical_offset);
  Pipeline pipeline(config);
  Guarding observer(plants);
  const RunSummary summary = pipeline.run(source, calibration, observer, std::atomic<bool>{false});
  RealtimeThreads::disarm();
  if (!summary.failure.empty()) throw std::runtime_error(summary.failure);
  if (!observer.is_over()) throw std::runtime_error("the drive has too few sweeps");
}

void measure(Report& report) {
  run_drive(false);
  for (const char* thread : kThreads)
    report.exactly(format("heap calls on thread %s in %d sweeps after %d", thread,
                          static_cast<int>(kMeasured_sweeps), static_cast<int>(kWarmUp_sweeps)),
                   RealtimeThreads::count(thread), kMaxHeapCalls);
  const std::string culprit = RealtimeThreads::first_call();
  if (!culprit.empty()) std::printf("the first came from\n%s", culprit.c_str());

  run_drive(true);
  for (const char* thread : kThreads)
    report.exactly(format("heap calls found on thread %s when 2 are planted", thread),
                   RealtimeThreads::count(thread), kPlanted);
}

}  // namespace

// The linker sends the pipeline's calls of clock_gettime here (--wrap).
extern "C" int __real_clock_gettime(clockid_t clock, timespec* time);
extern "C" int __wrap_clock_gettime(clockid_t clock, timespec* time) {
  if (clock == CLOCK_THREAD_CPUTIME_ID) allocate_if_planted();
  return __real_clock_gettime(clock, time);
}

int main() {
  return claims::run("heap calls", measure);
}
