// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/pipeline.hpp"

#include <exception>
#include <optional>
#include <utility>

#include "exchange.hpp"
#include "live_watch.hpp"
#include "map_feed.hpp"
#include "pago/config/load.hpp"
#include "pago/core/error.hpp"
#include "pago/core/seqlock.hpp"
#include "pago/features/features.hpp"
#include "pago/ground/ground_stage.hpp"
#include "pago/mapping/mapper.hpp"
#include "pago/odometry/odometry.hpp"
#include "pago/pipeline/timed.hpp"
#include "pago/platform/thread.hpp"
#include "publication.hpp"

namespace pago {

namespace {

/// Keyframes on their way to the saved map: the publisher may lag by so many.
constexpr std::uint32_t kMapClouds = 4;

}  // namespace

struct Pipeline::Parts {
  Parts(const Config& c, Pace p, output::Decisions d)
      : config(c),
        pace(p),
        decisions(std::move(d)),
        max_returns(max_returns_of(c.assembly, /*can_be_dual=*/true)),
        ring(static_cast<std::size_t>(c.assembly.ring_size), max_returns),
        segmenter(c.ground, c.mount, max_returns),
        extractor(c.features, max_returns),
        mapper(c.mapping),
        odometer(c.odometry, max_returns, mapper.refined()),
        pose_maker(c.publish.child, c.mount),
        parts(c.assembly.ring_size * c.assembly.sectors + 1, max_pending(), Recorded(decisions.superseded)),
        sweeps(c.assembly.ring_size + 1, max_pending()),
        freed(static_cast<std::uint32_t>(c.assembly.ring_size) + 1) {
    if (is_live()) board.emplace(c.publish.shared_memory);
  }

  bool is_live() const noexcept { return pace == Pace::kLive; }
  int max_pending() const noexcept { return is_live() ? config.pipeline.max_pending : 0; }

  //  source -> ingest ═parts═> ground -> features ═sweeps═> odometry -> pose ═news═> publisher
  //              ^                                                       │
  //              └──────────────────── freed sweeps <════════════════════┘
  template <typename Ingest>
  void flow(Ingest ingest, Observer& observer, RunSummary& summary) {
    Timed ground(StageId::kGround, segmenter);
    Timed features(StageId::kFeatures, extractor);
    Timed odometry(StageId::kOdometry, odometer);
    PublishPose first_pose(output::PoseKind::kFirst, pose_maker, board ? &*board : nullptr, outlet);
    PublishPose refined_pose(output::PoseKind::kRefined, pose_maker, board ? &*board : nullptr, outlet);
    PublishMount mount_verdict(segmenter, verdict);
    Chain front(ground, features, mount_verdict);
    Timed mapping(StageId::kMapping, mapper);
    Update next_targets(odometer);
    Update next_map(mapper);
    Chain after(next_targets, next_map);
    Timed update(StageId::kUpdate, after);
    Chain estimate(odometry, first_pose, mapping, refined_pose, update, map_feed);
    const auto begin_anew = [this, resets = Recorded(decisions.resets)](Sweep& sweep) mutable noexcept {
      // Relaxed: a wish, which guards no data.
      const bool is_asked = is_reset_requested.exchange(false, std::memory_order_relaxed);
      if (!is_asked && !resets.has(sweep.header.sequence)) return;
      sweep.header.flags |= kAfterReset;
      odometer.reset();
      mapper.reset();
    };
    const auto finish = [this](Sweep* sweep) noexcept {
      if (sweep == nullptr) return outlet.send({});
      count_fate(*sweep);
      outlet.send({News::Kind::kSweep, {}, output::make_record(*sweep), nullptr});
      push(freed, sweep);
    };

    if (std::exchange(has_run, true)) throw Error("pipeline", "runs once", "make a new one for another run");
    const PipelineConfig& on = config.pipeline;
    platform::Thread estimate_thread, front_thread, ingest_thread;
    try {
      //                                              thread                        does                writes
      estimate_thread = {plan("estimate", on.estimate),
                         [&] { run_sweeps(estimate, sweeps, begin_anew, finish); }};
      front_thread = {plan("front", on.front), [&] { run_parts(front, parts, sweeps); }};
      ingest_thread = {plan("ingest", on.ingest), [&] { ingest(), exchange.end(); }};
    } catch (...) {  // a thread could not be made: end those that wait already
      exchange.end();
      push(sweeps.channel, static_cast<Sweep*>(nullptr));
      throw;
    }

    for (const auto* thread : {&ingest_thread, &front_thread, &estimate_thread}) {
      summary.threads.push_back(platform::describe(thread->plan(), thread->grant()));
    }
    publish(observer);
    summary.mount = segmenter.mount_report();
    summary.sweeps.posed = fates.posed;
    summary.sweeps.partial = fates.partial;
    summary.sweeps.dropped[static_cast<std::size_t>(SweepDrop::kSuperseded)] = fates.dropped_total();
    summary.unrecorded = outlet.lost();
    summary.unmapped = map_feed.lost();
    summary.requests = exchange.requests();
  }

  platform::ThreadPlan plan(const char* name, const ThreadConfig& thread) const {
    platform::ThreadPlan result;
    result.name = name;
    result.cpu = thread.cpu;
    result.fifo_priority = is_live() ? thread.fifo_priority : 0;
    return result;
  }

  void count_fate(const Sweep& sweep) noexcept {
    const SweepHeader& header = sweep.header;
    if (header.has(kPartialStart) || header.has(kPartialEnd))
      ++fates.partial;
    else if (header.has(kSuperseded))
      ++fates.dropped[static_cast<std::size_t>(SweepDrop::kSuperseded)];
    else
      fates.posed += sweep.estimate.has_pose ? 1U : 0U;
  }

  void publish(Observer& observer) {
    std::exception_ptr thrown;
    News item;
    ground::MountReport mount;
    while (true) {
      const bool has_news = news.pop_wait(item, kTick_ns);
      if (has_news && item.kind == News::Kind::kEnd) break;
      const bool has_map_sweep = has_news && item.kind == News::Kind::kMapSweep;
      if (thrown) {  // let the threads come to their end
        if (has_map_sweep) map_feed.give_back(item.map_sweep);
        continue;
      }
      try {
        if (has_news && item.kind == News::Kind::kPose) observer.on_pose(item.pose);
        if (has_news && item.kind == News::Kind::kSweep) observer.on_sweep(item.record);
        if (has_map_sweep) observer.on_map_sweep(*item.map_sweep);
        if (mount.finding == ground::MountFinding::kPending && verdict.try_load(mount))
          observer.on_mount(mount);
        if (IngestStatus now; status.try_load(now)) observer.on_status(now);
      } catch (...) {
        thrown = std::current_exception();
        is_abandoned.store(true, std::memory_order_relaxed);
      }
      if (has_map_sweep) map_feed.give_back(item.map_sweep);
    }
    if (thrown) std::rethrow_exception(thrown);
  }

  /// Relaxed: flags that are acted on soon, not at once.
  bool goes_on(const std::atomic<bool>& stop) const noexcept {
    return !stop.load(std::memory_order_relaxed) && !is_abandoned.load(std::memory_order_relaxed);
  }

  Config config;
  Pace pace;
  output::Decisions decisions;  // of the recorded run that is repeated
  std::uint32_t max_returns;
  SweepRing ring;
  ground::GroundStage segmenter;
  features::FeaturesStage extractor;
  mapping::Mapper mapper;
  odometry::OdometryStage odometer;
  output::PoseMaker pose_maker;
  std::optional<output::PoseBoard> board;  // live

  // Between threads. Channels hold all that can be under way, and the end mark.
  Link<SweepPart> parts;
  Link<Sweep*> sweeps;
  platform::Channel<Sweep*> freed;
  platform::Channel<News> news{256};
  Seqlock<IngestStatus> status;
  Seqlock<ground::MountReport> verdict;
  RingExchange exchange{ring, freed, parts, pace, Recorded(decisions.unmet)};
  Outlet outlet{news, /*waits=*/pace == Pace::kReplay};
  MapFeed map_feed{config.output.map.save ? kMapClouds : 0, mapper.refined(), outlet,
                   /*waits=*/pace == Pace::kReplay};
  SweepCounters fates;  // of the sweeps that came through
  bool has_run = false;
  std::atomic<bool> is_reset_requested{false};
  std::atomic<bool> is_abandoned{false};
};

Pipeline::Pipeline(const Config& config, Pace pace, output::Decisions as_recorded) {
  validate(config);
  parts_ = std::make_unique<Parts>(config, pace, std::move(as_recorded));
}
Pipeline::~Pipeline() = default;

void Pipeline::request_reset() noexcept {
  parts_->is_reset_requested.store(true, std::memory_order_relaxed);
}

namespace {

IngestStatus status_of(const PacketSource& source,
                       const PacketIngest& ingest,
                       std::int64_t last_delivery_ns) {
  return {.progress = source.progress(),
          .source = source.counters(),
          .packets = ingest.packets(),
          .firings = ingest.firings(),
          .sweeps = ingest.sweeps(),
          .last_delivery_ns = last_delivery_ns,
          .rotation_hz = ingest.rotation_hz(),
          .clock_drift_ppm = ingest.clock_offset().drift_ppm(),
          .said = ingest.status().status(),
          .other_sender = ingest.packets().filtered > 0 ? ingest.sender().other_ipv4() : 0,
          .sensor = ingest.sensor(),
          .is_refused = ingest.is_refused(),
          .is_calibration_wrong =
              ingest.calibration_difference() && ingest.calibration_difference()->is_other_unit(),
          .is_view_limited = ingest.is_view_limited()};
}

void note(RunSummary& summary, const PacketSource& source, const PacketIngest& ingest) {
  summary.source = source.counters();
  summary.packets = ingest.packets();
  summary.firings = ingest.firings();
  const AssemblyCounters& sweeps = ingest.sweeps();
  summary.sweeps.opened = sweeps.opened;
  summary.sweeps.in_flight = sweeps.is_open;
  summary.sweeps.dropped[static_cast<std::size_t>(SweepDrop::kNoFreeSweep)] = sweeps.no_free_sweep;
  summary.incomplete_sweeps = sweeps.incomplete;
  summary.sensor = hdl64::name(ingest.sensor());
  summary.said = ingest.status().status();
  summary.clock_restarts = ingest.clock_restarts();
  summary.self_hits = ingest.self_hits();
}

}  // namespace

RunSummary Pipeline::run(PacketSource& source,
                         const hdl64::Calibration& calibration,
                         Observer& observer,
                         const std::atomic<bool>& stop) {
  Parts& p = *parts_;
  PacketIngest ingest(p.config.assembly, p.config.hdl64, calibration, p.exchange,
                      SelfFilter(p.config.vehicle, p.config.mount));
  p.exchange.label_by(source);
  LiveWatch watch;
  RunSummary summary;
  p.flow(
      [&] {
        // Live, what cannot be read may be replaced by what can.
        const auto is_over = [&] { return source.all_done() || (!p.is_live() && ingest.is_refused()); };
        std::int64_t last_delivery_ns = 0;
        while (!is_over() && p.goes_on(stop)) {
          const std::span<const Datagram> batch = source.receive();
          for (const Datagram& datagram : batch) ingest.push(datagram);
          if (!batch.empty()) last_delivery_ns = platform::monotonic_ns();
          if (p.is_live()) watch.after_batch(batch.empty(), ingest);
          p.status.store(status_of(source, ingest, last_delivery_ns));
        }
        summary.interrupted = !is_over();
        ingest.finish();
        note(summary, source, ingest);
        summary.failure = ingest.refusal();
      },
      observer, summary);
  summary.complaint = source.complaint();
  return summary;
}

RunSummary Pipeline::run(SweepSource& source, Observer& observer, const std::atomic<bool>& stop) {
  Parts& p = *parts_;
  if (p.is_live()) throw Error("pipeline", "scans come from files: they are replayed, not received");
  RunSummary summary;
  p.flow(
      [&] {
        IngestStatus status;
        bool goes_on = true;
        while ((goes_on = p.goes_on(stop))) {
          Sweep* sweep = p.exchange.acquire();
          sweep->clear_stale_columns();
          if (!source.fill(*sweep)) break;
          ++summary.sweeps.opened;
          summary.incomplete_sweeps += sweep->header.has(kIncomplete) ? 1U : 0U;
          p.exchange.hand_on({sweep, sweep->size, sweep->header.num_columns, true});
          status.progress = source.progress();
          p.status.store(status);
        }
        summary.interrupted = !goes_on;
        summary.failure = source.complaint();
      },
      observer, summary);
  return summary;
}

}  // namespace pago
