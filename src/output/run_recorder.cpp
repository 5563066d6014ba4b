// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/run_recorder.hpp"

#include "pago/core/error.hpp"
#include "pago/core/text.hpp"

namespace pago::output {

RunRecorder::RunRecorder(const std::filesystem::path& folder,
                         const OutputConfig& config,
                         StageThreads threads)
    : folder_(folder),
      flush_interval_(std::chrono::duration_cast<Clock::duration>(
          std::chrono::duration<double>(config.flush_interval_s))),
      next_flush_(Clock::now() + flush_interval_),
      front_end_(folder, "front_end"),
      first_(folder, "odometry"),
      refined_(folder, "trajectory"),
      poses_(folder / "poses.csv"),
      latency_(folder / "latency.csv"),
      trace_(static_cast<std::size_t>(config.trace_sweeps), threads) {
  if (config.map.save) map_.emplace(folder, config.map);
}

void RunRecorder::add(const MapSweep& sweep) {
  if (!map_) return;
  map_->add(sweep);
  totals_.num_keyframes = map_->num_keyframes();
  totals_.num_map_points = map_->num_points();
}

void RunRecorder::add(const SweepRecord& record) {
  if (record.header.has(kAfterReset) && map_ && map_->num_keyframes() != 0) {
    write_map(format("map_until_%llu.ply", static_cast<unsigned long long>(newest_sequence_)));
    map_->clear();
  }
  totals_.add(record);
  trace_.add(record);
  decisions_.add(record);
  newest_sequence_ = record.header.sequence;
  latency_.write(record);
  if (record.has_pose) {
    front_end_.write(record.stamp_ns, record.T_odom_sensor_front_end);
    first_.write(record.stamp_ns, record.T_odom_sensor_first);
    refined_.write(record.stamp_ns, record.T_odom_sensor_refined);
    poses_.write(record);
  }
  if (Clock::now() >= next_flush_) flush();
}

void RunRecorder::flush() noexcept {
  front_end_.flush();
  first_.flush();
  refined_.flush();
  poses_.flush();
  latency_.flush();
  next_flush_ = Clock::now() + flush_interval_;
}

void RunRecorder::finish(const RunReport& report) {
  flush();
  end_complaints_.clear();
  if (report.requests) decisions_.close(*report.requests);
  write_at_end("run.json", run_json(report, totals_, decisions_));
  if (trace_.size() != 0) write_at_end("trace.json", trace_.json());
  write_map("map.ply");
}

std::string RunRecorder::save_trace() {
  if (trace_.size() == 0) return {};
  const std::string name = "trace_" + std::to_string(newest_sequence_) + ".json";
  const std::size_t before = end_complaints_.size();
  write_at_end(name.c_str(), trace_.json());
  return end_complaints_.size() == before ? (folder_ / name).string() : std::string();
}

void RunRecorder::write_at_end(const char* name, const std::string& text) {
  try {
    replace_file(folder_ / name,
                 [&](const std::filesystem::path& unfinished) { write_file(unfinished, text); });
  } catch (const Error& error) {
    end_complaints_.emplace_back(error.what());
  }
}

void RunRecorder::write_map(const std::string& name) {
  if (!map_) return;
  try {
    map_->write(name);
  } catch (const Error& error) {
    end_complaints_.emplace_back(error.what());
  }
}

std::vector<std::string> RunRecorder::complaints() const {
  std::vector<std::string> complaints;
  for (const std::string& complaint : {front_end_.complaint(), first_.complaint(), refined_.complaint(),
                                       poses_.complaint(), latency_.complaint()})
    if (!complaint.empty()) complaints.push_back(complaint);
  if (map_ && !map_->complaint().empty()) complaints.push_back(map_->complaint());
  complaints.insert(complaints.end(), end_complaints_.begin(), end_complaints_.end());
  return complaints;
}

}  // namespace pago::output
