// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>
#include <vector>

#include "commands.hpp"
#include "pago/config/load.hpp"
#include "pago/core/deskew.hpp"
#include "pago/core/error.hpp"
#include "pago/evaluation/scan_statistics.hpp"
#include "pago/output/text_file.hpp"
#include "pago/pipeline/odometry.hpp"
#include "pago/report/scan_page.hpp"
#include "progress_line.hpp"
#include "settings.hpp"
#include "signals.hpp"
#include "source.hpp"

namespace pago::app {

namespace {

struct CompareOptions {
  std::vector<std::string> sources;
  std::string html;
  bool json = false;
  std::uint64_t most_sweeps = 0;
  SettingsOptions settings;
};

/// Poses for the middle of each sweep, so that sweeps can be laid over each other; and ground masks.
class Placing {
 public:
  explicit Placing(const Config& config) : odometry_(with_middle(config)) {}

  /// The sweep gets its ground mask. Throws Error if it cannot be used.
  Estimate place(Sweep& sweep) {
    const bool is_compensated = sweep.header.has(kCompensated);
    points_m_.clear();
    times_s_.clear();
    for (std::uint32_t i = 0; i < sweep.size; ++i) {
      points_m_.emplace_back(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
      if (!is_compensated) times_s_.push_back(static_cast<float>(sweep.time_offset_ns[i]) * 1e-9F);
    }
    const std::int64_t duration_ns = sweep.header.end_ns - sweep.header.start_ns;
    const Estimate estimate = odometry_.process({.points_m = points_m_,
                                                 .times_s = times_s_,
                                                 .rings = sweep.ring.first(sweep.size),
                                                 .stamp_ns = sweep.header.start_ns,
                                                 .duration_ns = duration_ns});
    if (!odometry_.refusal().empty())
      throw Error("sweep " + std::to_string(sweep.header.sequence), std::string(odometry_.refusal()));
    std::ranges::copy(odometry_.ground(), sweep.ground.begin());
    return estimate;
  }

 private:
  static Config with_middle(Config config) {
    config.odometry.pose_instant = PoseInstant::kMid;
    config.assembly.max_returns = static_cast<int>(max_returns_of(config.assembly, /*can_be_dual=*/true));
    return config;
  }
  Odometry odometry_;
  std::vector<Eigen::Vector3f> points_m_;
  std::vector<float> times_s_;
};

/// The returns as from the middle of the sweep, in the frame of another place.
evaluation::Cloud at_rest(const Sweep& sweep,
                          const Estimate& estimate,
                          const Eigen::Isometry3d& T_there_here) {
  const Deskew deskew(sweep.header.has(kCompensated) ? Vector6d::Zero().eval() : estimate.twist);
  const std::int64_t middle_ns = (sweep.header.end_ns - sweep.header.start_ns) / 2;
  const Eigen::Isometry3f T = T_there_here.cast<float>();
  evaluation::Cloud cloud;
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3f p(sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]);
    if (p.isZero(0.0F)) continue;
    const auto before_s = static_cast<float>(middle_ns - sweep.time_offset_ns[i]) * 1e-9F;
    cloud.push_back(T * deskew(p, before_s));
  }
  return cloud;
}

class Scanning {
 public:
  explicit Scanning(const Config& config) : placing_(config) {}

  void add(Sweep& sweep) {
    const Estimate estimate = placing_.place(sweep);
    add_returns(sweep, statistics_);
    add_ground_patches(sweep, statistics_);
    add_surfaces(sweep, statistics_);
    const Eigen::Isometry3d& T_odom_sensor = estimate.T_odom_sensor_refined;
    if (estimate.health == Health::kOk && !last_.empty())
      add_overlap(last_, at_rest(sweep, estimate, T_odom_last_.inverse() * T_odom_sensor), statistics_);
    // What was placed by a guess is nothing to lie on.
    last_ = estimate.health == Health::kOk ? at_rest(sweep, estimate, Eigen::Isometry3d::Identity())
                                           : evaluation::Cloud{};
    T_odom_last_ = T_odom_sensor;
  }
  evaluation::ScanStatistics& statistics() { return statistics_; }

 private:
  Placing placing_;
  evaluation::ScanStatistics statistics_;
  evaluation::Cloud last_;  // in its own frame
  Eigen::Isometry3d T_odom_last_ = Eigen::Isometry3d::Identity();
};

evaluation::ScannedDrive scan(const std::string& name, const CompareOptions& options) {
  Config config = options.settings.load();
  validate(config);
  OpenSource source = open_recording(name, config);
  SweepReader reader = reader_of(source, config);
  Scanning scanning(config);
  ProgressLine line;
  std::uint64_t sweeps = 0;
  while (options.most_sweeps == 0 || sweeps < options.most_sweeps) {
    Sweep* const sweep = reader.next();
    if (sweep == nullptr) break;
    if (stop_requested()) throw Error(name, "stopped by a signal: nothing is compared");
    if (!sweep->header.is_posed()) continue;
    scanning.add(*sweep);
    line.count_to(++sweeps);
    line.show(progress_of(source));
  }
  if (!reader.failure().empty()) throw Error(name, reader.failure());
  if (sweeps == 0) throw Error(name, "holds no whole sweep");
  return {name, std::move(scanning.statistics())};
}

int compare_command(const CompareOptions& options) {
  stop_on_signals();
  std::vector<evaluation::ScannedDrive> drives;
  for (const std::string& name : options.sources) drives.push_back(scan(name, options));
  std::cout << (options.json ? scan_json(drives) : scan_table(drives));
  if (options.html.empty()) return 0;
  std::string made_by = "pago " PAGO_VERSION " compare";
  for (const std::string& name : options.sources) made_by += ' ' + name;
  output::write_file(options.html, report::scan_page(drives, made_by));
  return 0;
}

}  // namespace

void add_compare_command(CLI::App& program, Action& action) {
  CLI::App& command = *program.add_subcommand(
      "compare", "what the sweeps of drives look like, side by side: real ones and simulated ones");
  const auto options = std::make_shared<CompareOptions>();
  command
      .add_option("sources", options->sources,
                  "drive.pcap, folders of KITTI scans (kitti:sequences/00), sim:urban")
      ->type_name("SOURCE...")
      ->required();
  command.add_option("--html", options->html, "a page that needs nothing but this file")->type_name("FILE");
  command.add_flag("--json", options->json, "figures and curves as JSON, not as a table");
  command.add_option("--sweeps", options->most_sweeps, "at most so many sweeps of each; default: all")
      ->check(CLI::Range(1, 1'000'000'000).description(""))
      ->type_name("N");
  options->settings.add_to(command);
  command.callback([&action, options] { action = [options] { return compare_command(*options); }; });
}

}  // namespace pago::app
