// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/simulator/render.hpp"

#include <iterator>
#include <memory>

#include "faults.hpp"
#include "kitti_folder.hpp"
#include "pago/core/error.hpp"
#include "pago/output/text_file.hpp"
#include "pago/pcap/pcap_writer.hpp"
#include "pago/simulator/packet_labels.hpp"
#include "pago/simulator/simulator.hpp"
#include "pago/simulator/unit.hpp"
#include "pictures.hpp"
#include "scan_collector.hpp"
#include "truth_files.hpp"

namespace pago::simulator {
namespace {

constexpr std::uint64_t kProgressEvery = 64;  // packets: 20 ms of the drive

/// What writers note instead of throwing.
void check(const std::string& complaint) {
  if (!complaint.empty()) throw Error("simulator", complaint, "is there room on the disk?");
}

void check_distinct(const DriveFiles& files) {
  const std::filesystem::path* const all[] = {&files.pcap,  &files.labels, &files.calibration,
                                              &files.truth, &files.kitti,  &files.pictures};
  for (std::size_t i = 0; i < std::size(all); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (!all[i]->empty() && all[i]->lexically_normal() == all[j]->lexically_normal())
        throw Error(all[i]->string(), "is named twice", "each output needs a name of its own");
}

/// The drive's outputs that are written packet by packet.
class Outputs {
 public:
  Outputs(const Simulator& drive, const Config& config, const DriveFiles& files)
      : drive_(drive),
        picture_scan_(drive.num_sweeps() / 2),
        pictures_(files.pictures),
        way_(config.simulator.faults, drive.start_ns(), static_cast<std::uint64_t>(config.simulator.seed)) {
    if (!files.pcap.empty()) pcap_ = std::make_unique<PcapWriter>(files.pcap);
    if (!files.labels.empty())
      labels_ = std::make_unique<LabelWriter>(files.labels, drive.format().firing_period_ns,
                                              drive.format().firings());
    if (!files.kitti.empty()) kitti_ = std::make_unique<KittiFolder>(files.kitti);
    if (files.kitti.empty() && files.pictures.empty()) return;
    scans_ = std::make_unique<ScanCollector>(
        drive, config.hdl64, files.kitti_compensated,
        [this](std::uint64_t scan, const LabelledRings& rings) { use(scan, rings); });
  }
  Outputs(const Outputs&) = delete;
  Outputs& operator=(const Outputs&) = delete;

  void add(const SimulatedPacket& packet) {
    if (pcap_) {
      way_.pass(packet, arrived_);
      write_arrived();
    }
    if (labels_) labels_->write(packet);
    if (scans_) scans_->add(packet);
  }

  void check_files() const {
    if (pcap_) check(pcap_->complaint());
    if (labels_) check(labels_->complaint());
  }

  void finish(std::uint64_t num_sweeps) {
    if (pcap_) {
      way_.finish(arrived_);
      write_arrived();
      pcap_->flush();
    }
    if (labels_) labels_->flush();
    check_files();
    if (scans_) scans_->finish(num_sweeps);
    if (kitti_) kitti_->finish(drive_, num_sweeps);
  }

 private:
  void write_arrived() {
    for (const SentPacket& packet : arrived_) pcap_->write(packet.payload(), packet.arrival_ns);
    arrived_.clear();
  }
  void use(std::uint64_t scan, const LabelledRings& rings) const {
    if (kitti_) kitti_->write_scan(scan, rings);
    if (!pictures_.empty() && scan == picture_scan_) draw_scan(rings, pictures_);
  }

  const Simulator& drive_;
  std::uint64_t picture_scan_;
  std::filesystem::path pictures_;
  FaultyWay way_;
  std::vector<SentPacket> arrived_;
  std::unique_ptr<PcapWriter> pcap_;
  std::unique_ptr<LabelWriter> labels_;
  std::unique_ptr<KittiFolder> kitti_;
  std::unique_ptr<ScanCollector> scans_;
};

}  // namespace

std::uint64_t render(const Config& config,
                     const DriveFiles& files,
                     const std::function<void(const Progress&)>& on_progress,
                     const std::atomic<bool>& stop) {
  check_distinct(files);
  Simulator drive(config.simulator, config.hdl64, config.mount);
  if (!files.calibration.empty()) output::write_file(files.calibration, calibration_xml(drive.calibration()));
  if (!files.truth.empty()) output::write_file(files.truth, "");  // fails before the work
  Outputs outputs(drive, config, files);
  SimulatedPacket packet;
  std::uint64_t done = 0;
  std::int64_t until_ns = drive.start_ns();
  while (!stop.load(std::memory_order_relaxed) && drive.next(packet)) {
    outputs.add(packet);
    until_ns = packet.time_ns + drive.format().packet_period_ns();
    if (++done % kProgressEvery != 0) continue;
    outputs.check_files();
    on_progress({static_cast<double>(done), static_cast<double>(drive.num_packets())});
  }
  const std::uint64_t num_sweeps = drive.sweeps_until(until_ns);
  outputs.finish(num_sweeps);
  if (!files.truth.empty()) write_truth(drive, num_sweeps, until_ns, files.truth);
  return num_sweeps;
}

DriveFiles files_in(const std::filesystem::path& folder) {
  DriveFiles files;
  files.pcap = folder / "packets.pcap";
  files.labels = folder / "packets.labels";
  files.calibration = folder / "calibration.xml";
  files.truth = folder / "truth.tum";
  return files;
}

}  // namespace pago::simulator
