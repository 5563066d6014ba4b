// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ground_scoring.hpp"

#include <vector>

#include "pago/core/stage.hpp"
#include "pago/ground/segmenter.hpp"
#include "pago/pipeline/sweep_reader.hpp"
#include "pago/simulator/labelled_capture.hpp"

namespace pago::app {

evaluation::GroundSummary score_ground(const Config& config,
                                       const hdl64::Calibration& calibration,
                                       const std::filesystem::path& pcap,
                                       const std::filesystem::path& labels,
                                       evaluation::GroundProtocol protocol) {
  const auto segmenter = ground::make_segmenter(config.ground, config.mount,
                                                max_returns_of(config.assembly, /*can_be_dual=*/true));
  LabelledCapture capture(pcap, config.packets, config.capture, labels, calibration);
  SweepReader reader(config, capture, calibration);
  std::vector<evaluation::GroundCounts> frames;
  while (Sweep* const sweep = reader.next()) {
    if (!sweep->header.is_posed()) continue;
    process(*segmenter, *sweep);
    frames.push_back(count_ground(protocol, *sweep, config.mount));
  }
  return evaluation::summarize_ground(frames);
}

}  // namespace pago::app
