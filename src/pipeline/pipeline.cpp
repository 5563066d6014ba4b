// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/pipeline.hpp"

#include <exception>
#include <utility>

#include "exchange.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/features/features.hpp"
#include "pago/ground/ground_stage.hpp"
#include "pago/odometry/odometry.hpp"
#include "pago/pipeline/timed.hpp"
#include "pago/platform/thread.hpp"
#include "runner.hpp"

namespace pago {

namespace {

/// What travels to the publisher.
struct Published {
  output::SweepRecord record;
  bool is_end = false;
};

platform::ThreadPlan plan(const char* name, const ThreadConfig& config) {
  platform::ThreadPlan result;
  result.name = name;
  result.cpu = config.cpu;
  return result;
}

}  // namespace

struct Pipeline::Parts {
  explicit Parts(const Config& c)
      : config(c),
        max_returns(static_cast<std::uint32_t>(c.assembly.max_returns)),
        ring(static_cast<std::size_t>(c.assembly.ring_size), max_returns),
        segmenter(c.ground, c.mount, max_returns),
        extractor(c.features, max_returns),
        odometer(c.odometry, max_returns),
        parts(elements(c.assembly.ring_size * c.assembly.sectors)),
        sweeps(elements(c.assembly.ring_size)),
        freed(elements(c.assembly.ring_size)) {}

  /// Room for all that can be under way and the end mark.
  static std::uint32_t elements(int under_way) { return static_cast<std::uint32_t>(under_way) + 1; }

  //  source -> ingest ═parts═> ground -> features ═sweeps═> odometry ═records═> publisher
  //              ^                                             │
  //              └──────────────── freed sweeps <══════════════┘
  template <typename Ingest>
  void flow(Ingest ingest, Observer& observer, RunSummary& summary) {
    Timed ground(StageId::kGround, segmenter);
    Timed features(StageId::kFeatures, extractor);
    Timed odometry(StageId::kOdometry, odometer);
    Chain front(ground, features);
    Chain estimate(odometry);
    const auto finish = [this](Sweep* sweep) noexcept {
      if (sweep == nullptr) return push(records, Published{{}, true});
      posed += sweep->estimate.has_pose ? 1 : 0;
      push(records, Published{output::make_record(*sweep), false});
      push(freed, sweep);
    };

    if (std::exchange(has_run, true)) throw Error("pipeline", "runs once", "make a new one for another run");
    const PipelineConfig& on = config.pipeline;
    platform::Thread estimate_thread, front_thread, ingest_thread;
    try {
      //                                              thread                        does                writes
      estimate_thread = {plan("estimate", on.estimate), [&] { run_sweeps(estimate, sweeps, finish); }};
      front_thread = {plan("front", on.front), [&] { run_parts(front, parts, sweeps); }};
      ingest_thread = {plan("ingest", on.ingest), [&] { ingest(), exchange.end(); }};
    } catch (...) {  // a thread could not be made: end those that wait already
      exchange.end();
      push(sweeps, static_cast<Sweep*>(nullptr));
      throw;
    }

    for (const auto* thread : {&ingest_thread, &front_thread, &estimate_thread}) {
      summary.threads.push_back(platform::describe(thread->plan(), thread->grant()));
    }
    publish(observer);
    summary.mount = segmenter.mount_report();
  }

  void publish(Observer& observer) {
    std::exception_ptr thrown;
    Published published;
    while (true) {
      const bool has_record = records.pop_wait(published, kTick_ns);
      if (has_record && published.is_end) break;
      if (thrown) continue;  // let the threads come to their end
      try {
        if (has_record) observer.on_sweep(published.record);
        observer.on_progress({done.load(std::memory_order_relaxed), total.load(std::memory_order_relaxed)});
      } catch (...) {
        thrown = std::current_exception();
        is_abandoned.store(true, std::memory_order_relaxed);
      }
    }
    if (thrown) std::rethrow_exception(thrown);
  }

  /// Relaxed throughout: numbers for a progress line, and a flag that is acted on soon, not at once.
  bool goes_on(const std::atomic<bool>& stop, const Progress& progress) noexcept {
    done.store(progress.done, std::memory_order_relaxed);
    total.store(progress.total, std::memory_order_relaxed);
    return !stop.load(std::memory_order_relaxed) && !is_abandoned.load(std::memory_order_relaxed);
  }

  Config config;
  std::uint32_t max_returns;
  SweepRing ring;
  ground::GroundStage segmenter;
  features::FeaturesStage extractor;
  odometry::OdometryStage odometer;
  platform::Channel<SweepPart> parts;
  platform::Channel<Sweep*> sweeps, freed;
  platform::Channel<Published> records{256};
  ReplayExchange exchange{ring, freed, parts};
  std::uint64_t posed = 0;
  bool has_run = false;
  std::atomic<double> done{0.0}, total{0.0};
  std::atomic<bool> is_abandoned{false};
};

Pipeline::Pipeline(const Config& config) {
  validate(config);
  parts_ = std::make_unique<Parts>(config);
}
Pipeline::~Pipeline() = default;

RunSummary Pipeline::run(PacketSource& source,
                         const hdl64::Calibration& calibration,
                         Observer& observer,
                         const std::atomic<bool>& stop) {
  Parts& p = *parts_;
  PacketIngest ingest(p.config.assembly, p.config.hdl64, calibration, p.exchange);
  RunSummary summary;
  p.flow(
      [&] {
        while (!source.all_done() && !ingest.is_refused() && p.goes_on(stop, source.progress())) {
          for (const Datagram& datagram : source.receive()) ingest.push(datagram);
        }
        summary.interrupted = !source.all_done() && !ingest.is_refused();
        ingest.finish();

        summary.source = source.counters();
        summary.packets = ingest.packets();
        summary.firings = ingest.firings();
        const AssemblyCounters& sweeps = ingest.sweeps();
        summary.sweeps.opened = sweeps.opened;
        summary.sweeps.partial = sweeps.partial;
        summary.sweeps.in_flight = sweeps.is_open;
        summary.sweeps.dropped[static_cast<std::size_t>(SweepDrop::kNoFreeSweep)] = sweeps.no_free_sweep;
        summary.incomplete_sweeps = sweeps.incomplete;
        summary.sensor = hdl64::name(ingest.sensor());
        summary.clock_restarts = ingest.clock_restarts();
        summary.failure = ingest.refusal();
      },
      observer, summary);
  summary.sweeps.posed = p.posed;
  summary.complaint = source.complaint();
  return summary;
}

RunSummary Pipeline::run(SweepSource& source, Observer& observer, const std::atomic<bool>& stop) {
  Parts& p = *parts_;
  RunSummary summary;
  p.flow(
      [&] {
        bool goes_on = true;
        while ((goes_on = p.goes_on(stop, source.progress()))) {
          Sweep* sweep = p.exchange.acquire();
          if (!source.fill(*sweep)) break;
          ++summary.sweeps.opened;
          summary.sweeps.partial += sweep->header.is_posed() ? 0U : 1U;
          summary.incomplete_sweeps += sweep->header.has(kIncomplete) ? 1U : 0U;
          p.exchange.hand_on({sweep, sweep->size, sweep->header.num_columns, true});
        }
        summary.interrupted = !goes_on;
        summary.failure = source.complaint();
      },
      observer, summary);
  summary.sweeps.posed = p.posed;
  return summary;
}

}  // namespace pago
