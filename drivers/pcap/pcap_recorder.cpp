// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/pcap_recorder.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <exception>
#include <memory>
#include <span>
#include <system_error>

#include "pago/core/spsc_queue.hpp"
#include "pago/core/text.hpp"
#include "pago/pcap/pcap_writer.hpp"
#include "pago/platform/clock.hpp"
#include "pago/platform/thread.hpp"

namespace pago {

namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kNap_ns = 10'000'000;        // waking for each datagram would cost the one who adds it
constexpr std::int64_t kSecond_ns = 1'000'000'000;  // between flushes, and between tries of a full disk
constexpr std::uint64_t kBytesPerMb = 1'000'000;

/// A datagram that waits for the disk.
struct Slot {
  std::int64_t arrival_ns;
  std::uint32_t source_ipv4;
  std::uint16_t source_port, destination_port, size;
  std::array<std::uint8_t, PcapWriter::kMaxPayloadBytes> payload;
};

std::uint32_t slots_in(int buffer_mb) {
  return static_cast<std::uint32_t>(static_cast<std::uint64_t>(buffer_mb) * kBytesPerMb / sizeof(Slot));
}

}  // namespace

struct PcapRecorder::State {
  explicit State(const RecordConfig& record)
      : config(record), queue(std::max(1U, slots_in(record.buffer_mb))) {
    begin_file();
    publish();
  }

  bool is_numbered() const noexcept { return config.file_mb > 0; }
  fs::path file_name(std::uint64_t number) const;
  void begin_file();
  void next_file() noexcept;
  void run() noexcept;
  void write(const Slot& slot) noexcept;
  void note_failure(const std::string& why) noexcept;
  void publish() noexcept;

  RecordConfig config;
  SpscQueue<Slot> queue;
  Slot in{}, out{};  // of the thread that adds, of the one that writes

  // Of the thread that writes.
  std::unique_ptr<PcapWriter> writer;
  std::uint64_t num_files = 0;
  std::uint64_t closed_records = 0, closed_bytes = 0, closed_lost = 0;  // of the files before this one
  std::int64_t flush_at_ns = 0, resume_at_ns = 0;
  std::string first_failure;

  // Relaxed: counts, which guard no data.
  std::atomic<std::uint64_t> offered{0}, no_room{0}, written{0}, failed{0}, bytes{0}, files{0};
  std::atomic<bool> is_over{false};  // released after the last add()
  platform::Thread thread;           // last: it uses all of the above
};

fs::path PcapRecorder::State::file_name(std::uint64_t number) const {
  const fs::path file(config.file);
  if (!is_numbered()) return file;
  const std::string name = format("_%04llu", static_cast<unsigned long long>(number));
  return file.parent_path() / (file.stem().string() + name + file.extension().string());
}

void PcapRecorder::State::begin_file() {
  writer = std::make_unique<PcapWriter>(file_name(num_files + 1));
  ++num_files;
  const auto kept = static_cast<std::uint64_t>(config.keep_files);
  std::error_code is_gone;
  if (kept > 0 && num_files > kept) fs::remove(file_name(num_files - kept), is_gone);
}

/// Where no next file can be made, the present one is gone on with.
void PcapRecorder::State::next_file() noexcept {
  writer->flush();
  if (!writer->complaint().empty()) return;
  const std::uint64_t records = writer->records(), size = writer->bytes(), lost = writer->lost();
  try {
    begin_file();
  } catch (const std::exception& error) {
    return note_failure(error.what());
  }
  closed_records += records;
  closed_bytes += size;
  closed_lost += lost;
}

void PcapRecorder::State::write(const Slot& slot) noexcept {
  const std::int64_t now_ns = platform::monotonic_ns();
  if (now_ns > resume_at_ns) {
    if (!writer->complaint().empty()) writer->resume();
    if (is_numbered() && writer->bytes() > static_cast<std::uint64_t>(config.file_mb) * kBytesPerMb)
      next_file();
  }
  const UdpEndpoints endpoints{.source_ipv4 = slot.source_ipv4,
                               .source_port = slot.source_port,
                               .destination_port = slot.destination_port};
  writer->write(std::span(slot.payload).first(slot.size), slot.arrival_ns, endpoints);
  if (now_ns > flush_at_ns) {
    flush_at_ns = now_ns + kSecond_ns;
    writer->flush();
  }
  if (!writer->complaint().empty() && now_ns > resume_at_ns) note_failure(writer->complaint());
}

void PcapRecorder::State::note_failure(const std::string& why) noexcept {
  resume_at_ns = platform::monotonic_ns() + kSecond_ns;
  if (first_failure.empty()) first_failure = why;
}

void PcapRecorder::State::publish() noexcept {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  written.store(closed_records + writer->records(), kRelaxed);
  failed.store(closed_lost + writer->lost(), kRelaxed);
  bytes.store(closed_bytes + writer->bytes(), kRelaxed);
  files.store(num_files, kRelaxed);
}

void PcapRecorder::State::run() noexcept {
  bool goes_on = true;
  while (goes_on) {
    // Acquire, before the queue is emptied: what was added before the end is in it.
    goes_on = !is_over.load(std::memory_order_acquire);
    while (queue.try_pop(out)) write(out);
    publish();
    if (goes_on) platform::sleep_until_ns(platform::monotonic_ns() + kNap_ns);
  }
  writer->flush();
  if (!writer->complaint().empty()) note_failure(writer->complaint());
  publish();
}

PcapRecorder::PcapRecorder(const RecordConfig& config) : state_(std::make_unique<State>(config)) {
  State& s = *state_;
  platform::ThreadPlan plan;
  plan.name = "record";
  s.thread = {plan, [&s] { s.run(); }};
}

PcapRecorder::~PcapRecorder() {
  finish();
}

void PcapRecorder::add(const Datagram& datagram) noexcept {
  State& s = *state_;
  s.offered.fetch_add(1, std::memory_order_relaxed);
  const std::size_t size = std::min(datagram.payload.size(), s.in.payload.size());
  s.in.arrival_ns = datagram.arrival_ns;
  s.in.source_ipv4 = datagram.source_ipv4;
  s.in.source_port = datagram.source_port;
  s.in.destination_port = datagram.destination_port;
  s.in.size = static_cast<std::uint16_t>(size);
  std::copy_n(datagram.payload.begin(), size, s.in.payload.begin());
  if (size < datagram.payload.size() || !s.queue.try_push(s.in))
    s.no_room.fetch_add(1, std::memory_order_relaxed);
}

void PcapRecorder::finish() noexcept {
  state_->is_over.store(true, std::memory_order_release);
  state_->thread.join();
}

RecordCounters PcapRecorder::counters() const noexcept {
  constexpr auto kRelaxed = std::memory_order_relaxed;
  const State& s = *state_;
  RecordCounters c;
  // The offered ones last: no more can have come to an end than were offered.
  c.written = s.written.load(kRelaxed);
  c.no_room = s.no_room.load(kRelaxed);
  c.failed = s.failed.load(kRelaxed);
  c.bytes = s.bytes.load(kRelaxed);
  c.files = s.files.load(kRelaxed);
  c.offered = std::max(s.offered.load(kRelaxed), c.written + c.no_room + c.failed);
  c.waiting = c.offered - c.written - c.no_room - c.failed;
  return c;
}

std::string PcapRecorder::complaint() const {
  const RecordCounters c = counters();
  if (c.unwritten() == 0 && state_->first_failure.empty()) return {};
  return "the recording lacks " + std::to_string(c.unwritten()) + " of " + std::to_string(c.offered) +
         " datagrams: " + (state_->first_failure.empty() ? "the disk was too slow" : state_->first_failure);
}

std::string PcapRecorder::files() const {
  const State& s = *state_;
  const std::uint64_t last = s.files.load(std::memory_order_relaxed);
  const auto kept = static_cast<std::uint64_t>(s.config.keep_files);
  const std::uint64_t first = kept > 0 && last > kept ? last - kept + 1 : 1;
  const std::string name = s.file_name(first).string();
  return first == last ? name : name + " ... " + s.file_name(last).filename().string();
}

}  // namespace pago
