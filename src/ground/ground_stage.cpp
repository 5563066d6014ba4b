// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/ground/ground_stage.hpp"

#include <cmath>
#include <optional>

#include "height_estimate.hpp"
#include "mount_check.hpp"

namespace pago::ground {

struct GroundStage::Parts {
  Parts(const GroundConfig& config, const Mount& mount, std::uint32_t max_returns)
      : segmenter(make_segmenter(config, mount, max_returns)),
        check(config.mount_check, mount),
        mount_height_m(mount.height_m),
        max_change_m(config.height.max_change_m),
        height_m(mount.height_m) {
    if (config.height.enabled) estimate.emplace(config.height, mount, max_returns);
  }

  bool waits_for_height() const noexcept { return estimate.has_value() && !is_estimated; }

  void estimate_height(const Sweep& sweep) noexcept {
    if (!sweep.header.is_posed() || sweep.header.has(kIncomplete)) return;
    const std::optional<double> found_m = (*estimate)(sweep);
    if (!found_m || std::abs(*found_m - mount_height_m) > max_change_m) return;
    is_estimated = true;
    height_m = *found_m;
    segmenter->set_height(height_m);
    check.note_height(height_m);
  }

  std::unique_ptr<Segmenter> segmenter;
  MountCheck check;
  std::optional<HeightEstimate> estimate;
  double mount_height_m, max_change_m;
  double height_m;
  bool is_estimated = false;
};

GroundStage::GroundStage(const GroundConfig& config, const Mount& mount, std::uint32_t max_returns)
    : parts_(std::make_unique<Parts>(config, mount, max_returns)) {}
GroundStage::~GroundStage() = default;
GroundStage::GroundStage(GroundStage&&) noexcept = default;
GroundStage& GroundStage::operator=(GroundStage&&) noexcept = default;

void GroundStage::begin(Sweep& sweep) noexcept {
  if (!parts_->waits_for_height()) parts_->segmenter->begin(sweep);
}

void GroundStage::accept(const SweepPart& part) noexcept {
  if (!parts_->waits_for_height()) parts_->segmenter->accept(part);
}

void GroundStage::finish(Sweep& sweep) noexcept {
  Parts& p = *parts_;
  if (p.waits_for_height()) {
    p.estimate_height(sweep);
    p.segmenter->begin(sweep);
  }
  p.segmenter->finish(sweep);
  p.check.look_at(sweep);
}

const MountReport& GroundStage::mount_report() const noexcept {
  return parts_->check.report();
}
double GroundStage::height_m() const noexcept {
  return parts_->height_m;
}

}  // namespace pago::ground
