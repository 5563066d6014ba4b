// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <set>
#include <string>

#include "log.hpp"
#include "pago/output/control.hpp"
#include "pago/output/pose_sender.hpp"
#include "pago/output/run_recorder.hpp"
#include "pago/pcap/pcap_recorder.hpp"
#include "pago/pipeline/pipeline.hpp"
#include "progress_line.hpp"

namespace pago::app {

/// The ways out of a live run beside its files, each open and usable.
struct LiveOutlets {
  std::unique_ptr<output::PoseSender> sender;
  std::unique_ptr<output::PoseLines> lines;
  std::unique_ptr<output::ControlServer> control;
  std::unique_ptr<PcapRecorder> packets;
};
/// [set-up] As configured. Throws Error: a destination, file or socket cannot be used.
LiveOutlets open_outlets(const Config& config);

/// What a live run does beside recording: tells poses to those who asked for them, says what the stream is
/// doing and what was lost, and answers `pago ctl`.
class LiveObserver final : public Observer {
 public:
  /// [set-up] Throws Error if there can be no log file in the recorder's folder.
  LiveObserver(LiveOutlets& outlets,
               std::string source,
               const Mount& mount,
               output::RunRecorder& recorder,
               std::function<output::RunReport(const IngestStatus&)> report_so_far,
               std::function<void()> reset);

  void on_sweep(const output::SweepRecord& record) override;
  void on_map_sweep(const output::MapSweep& sweep) override { recorder_.add(sweep); }
  void on_pose(const output::PoseV1& pose) override;
  void on_mount(const ground::MountReport& report) override;
  void on_status(const IngestStatus& status) override;

  Log& log() noexcept { return log_; }
  /// What went wrong beside the run itself, in whole sentences.
  std::vector<std::string> complaints() const;

 private:
  using Clock = std::chrono::steady_clock;

  std::string handle(output::Request request);
  std::string status_json() const;
  void note_state();
  void note_sensor();
  void note_losses();

  LiveOutlets& outlets_;
  std::string source_;
  Mount mount_;
  output::RunRecorder& recorder_;
  std::function<output::RunReport(const IngestStatus&)> report_so_far_;
  std::function<void()> reset_;
  Log log_;
  ProgressLine line_;

  Clock::time_point start_ = Clock::now(), next_losses_ = start_;
  IngestStatus now_, told_;  // told: what the last message about losses covered
  StreamState state_ = StreamState::kCount;
  Health health_ = Health::kInit;
  std::set<std::string> told_warnings_;
  std::uint64_t superseded_ = 0, told_superseded_ = 0, told_unwritten_ = 0;
  output::PoseV1 newest_{};
};

}  // namespace pago::app
