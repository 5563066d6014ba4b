// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause

// Datagrams into sweeps. The input is a program: six bytes are an instruction that sends, damages, repeats or
// leaves out packets of a true sensor, moves its clock or the host's, or sends bytes of the input. Whatever
// comes, every datagram, firing and sweep has one fate.
#include <algorithm>
#include <array>
#include <vector>

#include "fuzz/fuzz.hpp"
#include "pago/assembly/packet_ingest.hpp"
#include "support/packet_stream.hpp"

using namespace pago;

namespace {

constexpr std::uint32_t kMaxReturns = 64'000;
constexpr int kMostPackets = 400;  // of a program

/// Two sweeps serve all programs: making them takes longer than a program.
class Sink final : public SweepExchange {
 public:
  Sweep* acquire() noexcept override {
    const auto free = std::find(is_used_.begin(), is_used_.end(), false);
    if (free == is_used_.end()) return nullptr;
    *free = true;
    Sweep& sweep = sweeps()[static_cast<std::size_t>(free - is_used_.begin())];
    sweep.recycle();
    return &sweep;
  }
  void hand_on(const SweepPart& part) noexcept override {
    const Sweep& sweep = *part.sweep;
    fuzz::require(part.returns_until <= sweep.size && sweep.size <= kMaxReturns);
    if (!part.last) return;
    for (std::uint32_t i = 0; i < sweep.size; ++i)
      fuzz::require(sweep.ring[i] < kNumRings && sweep.column[i] < kMaxColumns);
    // One ring of each sweep, or it would take longer than the rest.
    check_ring(sweep, static_cast<int>(num_handed_on_++ % kNumRings));
    is_used_[part.sweep == &sweeps()[0] ? 0 : 1] = false;
  }

 private:
  static void check_ring(const Sweep& sweep, int ring) {
    for (int column = -kColumnMargin; column < kMaxColumns + kColumnMargin; ++column) {
      const std::int32_t cell = sweep.range_image.at(ring, column);
      if (cell == RangeImage::kEmpty) continue;
      const auto i = static_cast<std::uint32_t>(cell);
      fuzz::require(i < sweep.size && sweep.ring[i] == ring && sweep.column[i] == column);
    }
  }
  static std::vector<Sweep>& sweeps() {
    static std::vector<Sweep> both = [] {
      std::vector<Sweep> made;
      for (int i = 0; i < 2; ++i) made.emplace_back(kMaxReturns);
      return made;
    }();
    return both;
  }
  std::array<bool, 2> is_used_{};
  std::uint64_t num_handed_on_ = 0;
};

/// Carries a program out.
class Machine {
 public:
  Machine() : ingest_(small(), {}, unit(), sink_) {}

  void step(std::span<const std::uint8_t, 6> word, std::span<const std::uint8_t> rest) {
    const unsigned a = word[1], b = word[2] + 256U * word[3], c = word[4] + 256U * word[5];
    switch (word[0] % 12) {
      case 0:
      case 1:
        return send(static_cast<int>(a));
      case 2:
        next_ += b;
        return;
      case 3:  // a packet with a damaged byte
        return push(damaged(b, static_cast<std::uint8_t>(c)));
      case 4:  // once more, or out of order
        next_ -= std::min<std::int64_t>(next_, a % 8);
        return;
      case 5:
        settings_.stamp_us += b * 60'000U + c;
        return;
      case 6:
        settings_.arrival_ns += (static_cast<std::int64_t>(b) - 32'768) * 1'000'000 * (1 + a);
        return;
      case 7:
        return change_format(a);
      case 8:
        settings_.rotation_hz = static_cast<double>(b) / 1000.0 - (a % 2 == 0 ? 0.0 : 30.0);
        return;
      case 9:
        host_ = a % 4;
        return;
      case 10:
        return a % 2 == 0 ? ingest_.note_silence() : ingest_.probe_again();
      default:
        return push(rest.first(std::min<std::size_t>(rest.size(), 1500)));
    }
  }

  void end() {
    ingest_.finish();
    check();
    fuzz::require(ingest_.packets().pending == 0);
    fuzz::require(ingest_.refusal().size() < 1000);
  }

 private:
  static AssemblyConfig small() {
    AssemblyConfig config;
    config.max_returns = kMaxReturns;
    return config;
  }

  /// Lasers that look aside, so that columns run into the margins.
  static const hdl64::Calibration& unit() {
    static const hdl64::Calibration made = [] {
      hdl64::Calibration calibration;
      for (std::size_t i = 0; i < calibration.lasers.size(); ++i) {
        calibration.lasers[i].vertical_rad = 0.007 * static_cast<double>(i);
        calibration.lasers[i].rotation_rad = 0.02 * (static_cast<double>(i % 20) - 10.0);
      }
      calibration.ring_of_laser = hdl64::rank_rings(calibration.lasers);
      return calibration;
    }();
    return made;
  }
  void send(int count) {
    for (int i = 0; i < count && sent_ < kMostPackets; ++i) push(packet());
  }
  test::PacketBytes packet() { return test::PacketStream(settings_).packet(next_); }
  test::PacketBytes damaged(unsigned at, std::uint8_t value) {
    test::PacketBytes bytes = packet();
    bytes[at % bytes.size()] ^= value;
    return bytes;
  }
  void change_format(unsigned which) {
    const std::array formats{test::single_return(), test::single_return_s3(), test::dual_return(), test::s1(),
                             test::early_s2()};
    settings_.format = formats[which % formats.size()];
    settings_.block_times_ns = settings_.format.block_times_ns();
  }
  void push(std::span<const std::uint8_t> payload) {
    if (sent_++ >= kMostPackets) return;
    const test::PacketStream stream(settings_);
    ingest_.push({.payload = payload,
                  .arrival_ns = stream.arrival_ns(next_++),
                  .source_ipv4 = 0xC0A80300U + host_,
                  .source_port = 443,
                  .destination_port = 2368});
    check();
  }
  void check() const {
    fuzz::require(ingest_.packets().balanced());
    fuzz::require(ingest_.firings().balanced());
    fuzz::require(ingest_.sweeps().balanced());
  }

  Sink sink_;
  PacketIngest ingest_;
  test::StreamSettings settings_;
  std::int64_t next_ = 0;
  unsigned host_ = 0;
  int sent_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Machine machine;
  for (std::size_t i = 0; i + 6 <= size; i += 6)
    machine.step(std::span<const std::uint8_t, 6>(data + i, 6), {data + i + 6, size - i - 6});
  machine.end();
  return 0;
}
