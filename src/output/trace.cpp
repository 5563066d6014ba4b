// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/trace.hpp"

#include <algorithm>
#include <cinttypes>

#include "pago/core/text.hpp"
#include "pago/output/latency.hpp"

namespace pago::output {
namespace {

/// Threads are numbered by the first stage that runs on them.
std::size_t thread_id(const StageThreads& threads, std::size_t stage) {
  return static_cast<std::size_t>(std::find(threads.begin(), threads.end(), threads[stage]) -
                                  threads.begin());
}

std::string thread_names(const StageThreads& threads) {
  std::string events;
  for (std::size_t stage = 0; stage < kNumStages; ++stage)
    if (thread_id(threads, stage) == stage)
      events += format(R"({"name":"thread_name","ph":"M","pid":1,"tid":%zu,"args":{"name":"%s"}},)"
                       "\n",
                       stage, std::string(threads[stage]).c_str());
  return events;
}

std::string bar(const SweepRecord& record, std::size_t stage, std::size_t thread) {
  const StageTime& time = record.times[stage];
  return format(R"({"name":"%s","ph":"X","pid":1,"tid":%zu,"ts":%.3f,"dur":%.3f,)"
                R"("args":{"sweep":%)" PRIu64 R"(,"cpu_ms":%.4f}},)"
                "\n",
                std::string(stage_name(static_cast<StageId>(stage))).c_str(), thread,
                static_cast<double>(time.start_ns) * 1e-3,
                static_cast<double>(time.end_ns - time.start_ns) * 1e-3, record.header.sequence,
                static_cast<double>(time.cpu_ns) * 1e-6);
}

}  // namespace

Trace::Trace(std::size_t capacity, StageThreads threads) : capacity_(capacity), threads_(threads) {
  records_.reserve(capacity);
}

void Trace::add(const SweepRecord& record) {
  if (capacity_ == 0) return;
  if (records_.size() < capacity_) {
    records_.push_back(record);
  } else {
    records_[next_] = record;
  }
  next_ = (next_ + 1) % capacity_;
}

std::string Trace::json() const {
  std::string text = "{\"displayTimeUnit\":\"ms\",\"traceEvents\":[\n" + thread_names(threads_);
  for (std::size_t i = 0; i < records_.size(); ++i) {
    // Oldest first: at `next_` once the buffer is full, at 0 before.
    const SweepRecord& record = records_[records_.size() < capacity_ ? i : (next_ + i) % capacity_];
    for (std::size_t stage = 0; stage < kNumStages; ++stage)
      if (record.times[stage].end_ns != 0) text += bar(record, stage, thread_id(threads_, stage));
  }
  return text + R"({"name":"process_name","ph":"M","pid":1,"args":{"name":"pago"}}]})" + "\n";
}

}  // namespace pago::output
