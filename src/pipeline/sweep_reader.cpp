// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/pipeline/sweep_reader.hpp"

#include <deque>
#include <utility>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"

namespace pago {

class SweepReader::Input {
 public:
  virtual ~Input() = default;
  virtual Sweep* next() = 0;
  virtual std::string failure() const = 0;
};

class SweepReader::Packets final : public Input, private SweepExchange {
 public:
  Packets(const Config& config, PacketSource& source, const hdl64::Calibration& calibration)
      : source_(source),
        ring_(kSweeps, max_returns_of(config.assembly, /*can_be_dual=*/true)),
        ingest_(config.assembly, config.hdl64, calibration, *this, SelfFilter(config.vehicle, config.mount)) {
  }

  Sweep* next() override {
    if (given_ != nullptr) ring_.release(std::exchange(given_, nullptr));
    while (ready_.empty() && !is_finished_) work();
    if (ready_.empty()) return nullptr;
    given_ = ready_.front();
    ready_.pop_front();
    return given_;
  }
  std::string failure() const override { return ingest_.refusal(); }

 private:
  // Given out, two that the end of the stream may hand on together, being filled, and the one that the
  // assembler takes at a cut before it hands on.
  static constexpr std::size_t kSweeps = 5;

  /// One datagram at a time, so that sweeps do not pile up.
  void work() {
    if (pending_.empty() && !source_.all_done()) pending_ = source_.receive();
    if (!pending_.empty()) {
      ingest_.push(pending_.front());
      pending_ = pending_.subspan(1);
    }
    if (ingest_.is_refused() || (pending_.empty() && source_.all_done())) {
      is_finished_ = true;
      ingest_.finish();
    }
  }

  Sweep* acquire() noexcept override { return ring_.try_acquire(); }
  void hand_on(const SweepPart& part) noexcept override {
    if (!part.last) return;
    if (source_.has_labels()) source_.label(*part.sweep);
    ready_.push_back(part.sweep);
  }

  PacketSource& source_;
  SweepRing ring_;
  PacketIngest ingest_;
  std::span<const Datagram> pending_;
  std::deque<Sweep*> ready_;
  Sweep* given_ = nullptr;
  bool is_finished_ = false;
};

class SweepReader::Scans final : public Input {
 public:
  Scans(const Config& config, SweepSource& source)
      : source_(source), ring_(1, max_returns_of(config.assembly, /*can_be_dual=*/true)) {}

  Sweep* next() override {
    if (given_ != nullptr) ring_.release(given_);
    given_ = ring_.try_acquire();
    given_->clear_stale_columns();
    return source_.fill(*given_) ? given_ : nullptr;
  }
  std::string failure() const override { return source_.complaint(); }

 private:
  SweepSource& source_;
  SweepRing ring_;
  Sweep* given_ = nullptr;
};

SweepReader::SweepReader(const Config& config, PacketSource& source, const hdl64::Calibration& calibration)
    : input_(std::make_unique<Packets>(config, source, calibration)) {}
SweepReader::SweepReader(const Config& config, SweepSource& source)
    : input_(std::make_unique<Scans>(config, source)) {}
SweepReader::~SweepReader() = default;

Sweep* SweepReader::next() {
  return input_->next();
}
std::string SweepReader::failure() const {
  return input_->failure();
}

}  // namespace pago
