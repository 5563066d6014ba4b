// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/latency.hpp"

#include <algorithm>
#include <cinttypes>
#include <string>

#include "pago/core/text.hpp"

namespace pago::output {
namespace {

constexpr double kMsPerNs = 1e-6;
constexpr std::int64_t kNone = -1;

std::int64_t pose_ns(const SweepRecord& record, StageId stage) noexcept {
  const StageTime& time = record.time_of(stage);
  if (!record.has_pose || time.end_ns == 0) return kNone;
  return std::max<std::int64_t>(0, time.end_ns - record.header.complete_ns);
}

std::string cell(bool is_there, std::int64_t duration_ns) {
  return is_there ? format(",%.4f", static_cast<double>(duration_ns) * kMsPerNs) : ",";
}

}  // namespace

std::string_view stage_name(StageId stage) noexcept {
  constexpr std::array<std::string_view, kNumStages> kNames{"ingest",   "ground",  "features",
                                                            "odometry", "mapping", "update"};
  return kNames[static_cast<std::size_t>(stage)];
}

std::array<StageSplit, kNumStages> split_times(const SweepRecord& record) noexcept {
  std::array<StageSplit, kNumStages> splits;
  const StageTime* before = nullptr;
  for (std::size_t i = 0; i < kNumStages; ++i) {
    const StageTime& time = record.times[i];
    if (time.end_ns == 0) continue;
    splits[i].ran = true;
    splits[i].run_ns = time.end_ns - time.start_ns;
    splits[i].cpu_ns = time.cpu_ns;
    if (before != nullptr) splits[i].wait_ns = std::max<std::int64_t>(0, time.start_ns - before->end_ns);
    before = &time;
  }
  return splits;
}

std::int64_t first_pose_ns(const SweepRecord& record) noexcept {
  return pose_ns(record, StageId::kOdometry);
}

std::int64_t refined_pose_ns(const SweepRecord& record) noexcept {
  return pose_ns(record, StageId::kMapping);
}

LatencySummary summarize(const LatencyHistogram& histogram) noexcept {
  return {histogram.count(), histogram.percentile(50), histogram.percentile(90), histogram.percentile(99),
          histogram.max()};
}

void LatencyReport::add(const SweepRecord& record) noexcept {
  const auto splits = split_times(record);
  for (std::size_t i = 0; i < kNumStages; ++i) {
    if (!splits[i].ran) continue;
    stages[i].wait.record(splits[i].wait_ns);
    stages[i].run.record(splits[i].run_ns);
    stages[i].cpu.record(splits[i].cpu_ns);
  }
  if (first_pose_ns(record) >= 0) first_pose.record(first_pose_ns(record));
  if (refined_pose_ns(record) >= 0) refined_pose.record(refined_pose_ns(record));
}

LatencyCsv::LatencyCsv(const std::filesystem::path& file) : file_(file) {
  std::string header = "sequence,stamp_ns";
  for (std::size_t i = 0; i < kNumStages; ++i)
    for (const char* part : {"wait", "run", "cpu"})
      header += format(",%s_%s_ms", std::string(stage_name(static_cast<StageId>(i))).c_str(), part);
  file_.write(header + ",first_pose_ms,refined_pose_ms\n");
}

void LatencyCsv::write(const SweepRecord& record) noexcept {
  std::string row = format("%" PRIu64 ",%" PRId64, record.header.sequence, record.stamp_ns);
  for (const StageSplit& split : split_times(record))
    row += cell(split.ran, split.wait_ns) + cell(split.ran, split.run_ns) + cell(split.ran, split.cpu_ns);
  for (const std::int64_t duration_ns : {first_pose_ns(record), refined_pose_ns(record)})
    row += cell(duration_ns >= 0, duration_ns);
  file_.write(row + "\n");
}

}  // namespace pago::output
