// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <nlohmann/json.hpp>

#include "pago/output/pose_sender.hpp"

namespace pago::output {

std::string pose_line(const PoseV1& pose) {
  const nlohmann::ordered_json json = {{"kind", pose.kind == PAGO_POSE_FIRST ? "first" : "refined"},
                                       {"health", to_string(static_cast<Health>(pose.health))},
                                       {"reason", to_string(static_cast<HealthReason>(pose.reason))},
                                       {"sequence", pose.sequence},
                                       {"stamp_ns", pose.stamp_ns},
                                       {"last_arrival_ns", pose.last_arrival_ns},
                                       {"published_ns", pose.published_ns},
                                       {"frame_id", pose.frame_id},
                                       {"child_frame_id", pose.child_frame_id},
                                       {"position_m", pose.position_m},
                                       {"orientation_xyzw", pose.orientation_xyzw},
                                       {"twist", pose.twist},
                                       {"covariance", pose.covariance}};
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

PoseLines::PoseLines(const std::string& file) {
  if (file != "-") file_.emplace(file);
}

void PoseLines::write(const PoseV1& pose) {
  const std::string line = pose_line(pose);
  if (file_) {
    file_->write(line);
    file_->flush();
  } else {
    const bool is_written =
        std::fwrite(line.data(), 1, line.size(), stdout) == line.size() && std::fflush(stdout) == 0;
    if (!is_written) ++unwritten_;
  }
}

std::string PoseLines::complaint() const {
  if (file_) return file_->complaint();
  return unwritten_ == 0 ? std::string()
                         : std::to_string(unwritten_) + " poses could not be written to standard output";
}

}  // namespace pago::output
