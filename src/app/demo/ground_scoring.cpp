// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ground_scoring.hpp"

#include <vector>

#include "pago/assembly/packet_ingest.hpp"
#include "pago/assembly/sweep_ring.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/pcap/pcap_source.hpp"
#include "pago/simulator/packet_labels.hpp"

namespace pago::app {

namespace {

/// Segments and scores each whole sweep where the pipeline would queue it.
class Scorer final : public SweepExchange {
 public:
  Scorer(const Config& config,
         const hdl64::Calibration& calibration,
         const std::filesystem::path& labels,
         evaluation::GroundProtocol protocol)
      : ring_(2, max_returns_of(config.assembly, /*can_be_dual=*/true)),
        segmenter_(ground::make_segmenter(
            config.ground, config.mount, max_returns_of(config.assembly, /*can_be_dual=*/true))),
        labels_(labels),
        calibration_(calibration),
        protocol_(protocol) {}

  Sweep* acquire() noexcept override { return ring_.try_acquire(); }

  void hand_on(const SweepPart& part) noexcept override {
    Sweep& sweep = *part.sweep;
    if (part.last && sweep.header.is_posed()) {
      segmenter_->begin(sweep);
      segmenter_->accept(part);
      segmenter_->finish(sweep);
      labels_.label(sweep, calibration_);
      count(sweep);
    }
    if (part.last) ring_.release(&sweep);
  }

  evaluation::GroundSummary summary() const { return evaluation::summarize_ground(frames_); }

 private:
  void count(const Sweep& sweep) {
    const auto classes = sweep.label.first(sweep.size);
    const std::vector<std::uint32_t> labels(classes.begin(), classes.end());
    frames_.push_back(
        count_ground(protocol_, labels, sweep.z_m.first(sweep.size), sweep.ground.first(sweep.size)));
  }

  SweepRing ring_;
  std::unique_ptr<ground::Segmenter> segmenter_;
  simulator::LabelTrack labels_;
  const hdl64::Calibration& calibration_;
  evaluation::GroundProtocol protocol_;
  std::vector<evaluation::GroundCounts> frames_;
};

}  // namespace

evaluation::GroundSummary score_ground(const Config& config,
                                       const hdl64::Calibration& calibration,
                                       const std::filesystem::path& pcap,
                                       const std::filesystem::path& labels,
                                       evaluation::GroundProtocol protocol) {
  AssemblyConfig whole_sweeps = config.assembly;
  whole_sweeps.sectors = 1;
  Scorer scorer(config, calibration, labels, protocol);
  PacketIngest ingest(whole_sweeps, config.hdl64, calibration, scorer,
                      SelfFilter(config.vehicle, config.mount));
  PcapSource source(pcap, config.packets);
  while (!source.all_done())
    for (const Datagram& datagram : source.receive()) ingest.push(datagram);
  ingest.finish();
  return scorer.summary();
}

}  // namespace pago::app
