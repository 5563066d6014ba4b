// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/config/config.hpp"
#include "pago/pcap/pcap_source.hpp"

namespace pago::test {

/// The whole sweeps of a capture, decoded and assembled as the ingest thread does.
class RecordedSweeps final : private SweepExchange {
 public:
  /// Called with each part of a sweep while it arrives, the last one included.
  using Watch = std::function<void(const SweepPart&)>;

  RecordedSweeps(const std::filesystem::path& capture,
                 const std::filesystem::path& calibration,
                 int sectors = 1,
                 Watch watch = {})
      : config_(with(sectors)),
        source_(capture, config_.packets),
        ring_(3, max_returns_of(config_.assembly, /*can_be_dual=*/true)),
        ingest_(config_.assembly,
                config_.hdl64,
                hdl64::load_calibration(calibration, config_.hdl64.vertical_offset),
                *this),
        watch_(std::move(watch)) {}

  /// The next one, valid until the next call; null at the end. Parts of a rotation are passed over.
  Sweep* next() {
    do {
      if (given_ != nullptr) ring_.release(std::exchange(given_, nullptr));
      while (ready_ == nullptr && !is_finished_) work();
      given_ = std::exchange(ready_, nullptr);
    } while (given_ != nullptr && !given_->header.is_posed());
    return given_;
  }

 private:
  static Config with(int sectors) {
    Config config;
    config.assembly.sectors = sectors;
    return config;
  }

  /// One datagram, so that no more than one sweep is handed on.
  void work() {
    if (pending_.empty() && !source_.all_done()) pending_ = source_.receive();
    if (!pending_.empty()) {
      ingest_.push(pending_.front());
      pending_ = pending_.subspan(1);
    } else if (source_.all_done()) {
      is_finished_ = true;
      ingest_.finish();
      if (!ingest_.refusal().empty()) throw std::runtime_error(ingest_.refusal());
    }
  }

  Sweep* acquire() noexcept override { return ring_.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    if (watch_) watch_(part);
    if (part.last) ready_ = part.sweep;
  }

  Config config_;
  PcapSource source_;
  SweepRing ring_;
  PacketIngest ingest_;
  Watch watch_;
  std::span<const Datagram> pending_;
  Sweep* ready_ = nullptr;
  Sweep* given_ = nullptr;
  bool is_finished_ = false;
};

}  // namespace pago::test
