// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pcap/pcap_recorder.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <thread>
#include <vector>

#include "pago/core/error.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/pcap/pcap_writer.hpp"
#include "pago/pcap/recording_source.hpp"
#include "support/catch.hpp"
#include "support/new_counter.hpp"
#include "support/temporary_path.hpp"

using namespace pago;
using test::TemporaryPath;

namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kStart_ns = 1'700'000'000'123'456'789;

struct Sent {
  Bytes payload;
  Datagram datagram;
};

/// Datagrams of all lengths, from several senders to several ports.
std::vector<Sent> mixed_datagrams(std::size_t count) {
  std::vector<Sent> out(count);
  for (std::size_t i = 0; i < count; ++i) {
    out[i].payload.resize(i % 7 == 0 ? i * 37 % 2049 : 1206);
    for (std::size_t k = 0; k < out[i].payload.size(); ++k)
      out[i].payload[k] = static_cast<std::uint8_t>(i + 31 * k);
    out[i].datagram = {.payload = out[i].payload,
                       .arrival_ns = kStart_ns + static_cast<std::int64_t>(i) * 288'001,
                       .source_ipv4 = 0xC0A8032B + static_cast<std::uint32_t>(i % 3),
                       .source_port = static_cast<std::uint16_t>(443 + i % 2),
                       .destination_port = static_cast<std::uint16_t>(2368 + i % 5)};
  }
  return out;
}

RecordConfig to(const fs::path& file) {
  RecordConfig config;
  config.file = file.string();
  return config;
}

std::uint64_t datagrams_in(const fs::path& file) {
  PcapSource source(file, {.port = 0, .source_address = {}});
  while (!source.all_done()) source.receive();
  CHECK(source.complaint().empty());
  CHECK(source.counters().bad() == 0);
  return source.counters().delivered;
}

/// No file may grow beyond this, as on a disk that is full.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { lift(); }
  void lift() { setrlimit(RLIMIT_FSIZE, &before_); }

 private:
  rlimit before_{};
};

}  // namespace

TEST_CASE("what is recorded replays as it came", "[pcap][record]") {
  const TemporaryPath file(".pcap");
  const std::vector<Sent> sent = mixed_datagrams(500);
  PcapRecorder recorder(to(file.path()));
  for (const Sent& one : sent) recorder.add(one.datagram);
  recorder.finish();
  const RecordCounters counters = recorder.counters();
  CHECK(counters.written == 500);
  CHECK(counters.unwritten() + counters.waiting == 0);
  CHECK(counters.bytes == fs::file_size(file.path()));
  CHECK(recorder.complaint().empty());

  PcapSource source(file.path(), {.port = 0, .source_address = {}});
  std::size_t i = 0;
  while (!source.all_done()) {
    for (const Datagram& d : source.receive()) {
      REQUIRE(i < sent.size());
      const Datagram& was = sent[i].datagram;
      REQUIRE(Bytes(d.payload.begin(), d.payload.end()) == sent[i].payload);
      REQUIRE(d.arrival_ns == was.arrival_ns);
      REQUIRE(d.source_ipv4 == was.source_ipv4);
      REQUIRE(d.source_port == was.source_port);
      REQUIRE(d.destination_port == was.destination_port);
      ++i;
    }
  }
  CHECK(i == sent.size());
}

TEST_CASE("a recording source hands on what it records", "[pcap][record]") {
  const TemporaryPath original(".pcap"), copy(".pcap");
  {
    PcapRecorder recorder(to(original.path()));
    for (const Sent& one : mixed_datagrams(300)) recorder.add(one.datagram);
  }
  PcapSource source(original.path(), {.port = 0, .source_address = {}});
  PcapRecorder recorder(to(copy.path()));
  RecordingSource tap(source, recorder);
  std::uint64_t passed = 0;
  while (!tap.all_done()) passed += tap.receive().size();
  recorder.finish();
  CHECK(passed == 300);
  CHECK(tap.counters().delivered == 300);
  CHECK(datagrams_in(copy.path()) == 300);
}

TEST_CASE("adding to a recording allocates nothing", "[pcap][record]") {
  const TemporaryPath file(".pcap");
  const std::vector<Sent> sent = mixed_datagrams(300);
  PcapRecorder recorder(to(file.path()));
  const std::uint64_t before = test::news_so_far();
  for (const Sent& one : sent) recorder.add(one.datagram);
  CHECK(test::news_so_far() == before);
}

TEST_CASE("files of a limited size are numbered, and only the newest are kept", "[pcap][record]") {
  const TemporaryPath folder("");
  fs::create_directories(folder.path());
  RecordConfig config = to(folder.path() / "drive.pcap");
  config.file_mb = 1;
  config.keep_files = 2;
  const std::vector<Sent> sent = mixed_datagrams(3000);
  PcapRecorder recorder(config);
  for (const Sent& one : sent) recorder.add(one.datagram);
  recorder.finish();
  const RecordCounters counters = recorder.counters();
  REQUIRE(counters.written == 3000);
  REQUIRE(counters.files >= 4);
  std::uint64_t kept = 0, kept_bytes = 0;
  std::size_t num_files = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    kept += datagrams_in(entry.path());
    kept_bytes += entry.file_size();
    CHECK(entry.file_size() < 1'200'000);
    ++num_files;
  }
  CHECK(num_files == 2);
  CHECK(kept < 3000);
  CHECK(kept_bytes < counters.bytes);
  const std::string last = "drive_000" + std::to_string(counters.files) + ".pcap";
  CHECK(recorder.files().ends_with(" ... " + last));
  CHECK(fs::exists(folder.path() / last));
}

TEST_CASE("a full disk costs what it does not take, counted, and the file stays whole", "[pcap][record]") {
  const TemporaryPath file(".pcap");
  const std::vector<Sent> sent = mixed_datagrams(1000);
  PcapRecorder recorder(to(file.path()));
  {
    const FileSizeLimit full(300'000);
    for (const Sent& one : sent) recorder.add(one.datagram);
    recorder.finish();
  }
  const RecordCounters counters = recorder.counters();
  CHECK(counters.offered == 1000);
  CHECK(counters.failed > 0);
  CHECK(counters.written > 0);
  CHECK(counters.written + counters.failed == 1000);
  CHECK(datagrams_in(file.path()) == counters.written);
  CHECK(recorder.complaint().find("lacks " + std::to_string(counters.failed) + " of 1000") !=
        std::string::npos);
}

TEST_CASE("writing goes on when a full disk has room again", "[pcap][record]") {
  const TemporaryPath file(".pcap");
  const Bytes payload(1206, 0x5A);
  pago::PcapWriter writer(file.path());
  FileSizeLimit full(200'000);
  for (int i = 0; i < 400; ++i) writer.write(payload, kStart_ns + i);
  writer.flush();
  REQUIRE_FALSE(writer.complaint().empty());
  const std::uint64_t before = writer.records();
  CHECK(before + writer.lost() == 400);
  CHECK(fs::file_size(file.path()) == writer.bytes());
  full.lift();
  writer.resume();
  for (int i = 0; i < 100; ++i) writer.write(payload, kStart_ns + i);
  writer.flush();
  CHECK(writer.complaint().empty());
  CHECK(writer.records() == before + 100);
  CHECK(datagrams_in(file.path()) == before + 100);
}

TEST_CASE("a disk that takes nothing costs datagrams, never time", "[pcap][record]") {
  // A pipe that nobody reads blocks who writes to it.
  const TemporaryPath pipe(".pipe");
  REQUIRE(mkfifo(pipe.path().c_str(), 0600) == 0);
  const int reader = open(pipe.path().c_str(), O_RDWR | O_CLOEXEC);
  REQUIRE(reader >= 0);
  RecordConfig config = to(pipe.path());
  config.buffer_mb = 1;
  const std::vector<Sent> sent = mixed_datagrams(3000);
  PcapRecorder recorder(config);
  for (const Sent& one : sent) recorder.add(one.datagram);
  CHECK(recorder.counters().no_room > 0);
  CHECK(recorder.counters().offered == 3000);

  std::atomic<bool> is_over{false};
  std::thread drain([&] {
    fcntl(reader, F_SETFL, O_NONBLOCK);
    Bytes some(65536);
    while (!is_over)
      if (read(reader, some.data(), some.size()) <= 0) std::this_thread::yield();
  });
  recorder.finish();
  is_over = true;
  drain.join();
  close(reader);
  const RecordCounters counters = recorder.counters();
  CHECK(counters.written + counters.no_room == 3000);
  CHECK(recorder.complaint().find("too slow") != std::string::npos);
}

TEST_CASE("a recording that cannot begin is refused", "[pcap][record]") {
  CHECK_THROWS_AS(PcapRecorder(to("/nowhere/at/all.pcap")), Error);
  if (fs::exists("/dev/full")) CHECK_THROWS_AS(PcapRecorder(to("/dev/full")), Error);
}
