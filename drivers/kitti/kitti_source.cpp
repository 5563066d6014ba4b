// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/kitti/kitti_source.hpp"

#include <algorithm>
#include <cmath>

#include "folder.hpp"
#include "pago/core/units.hpp"
#include "scan_file.hpp"

namespace pago {
namespace {

using kitti::FilePoint;

/// What brings a file's intensities to 0-255: KITTI's own are in [0, 1], but converted sets are around.
float intensity_scale(std::span<const FilePoint> points) noexcept {
  const bool is_byte = std::ranges::any_of(
      points, [](const FilePoint& p) { return std::isfinite(p.intensity) && p.intensity > 1.5F; });
  return is_byte ? 1.0F : 255.0F;
}

std::uint8_t to_byte(float intensity) noexcept {
  return intensity > 0.0F ? static_cast<std::uint8_t>(std::min(255.0F, intensity) + 0.5F) : std::uint8_t{0};
}

void copy_points(std::span<const FilePoint> points, Sweep& sweep) noexcept {
  const float scale = intensity_scale(points);
  sweep.size = static_cast<std::uint32_t>(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const FilePoint& p = points[i];
    sweep.x_m[i] = p.x_m;
    sweep.y_m[i] = p.y_m;
    sweep.z_m[i] = p.z_m;
    sweep.intensity[i] = to_byte(p.intensity * scale);
  }
}

/// Turns every point up about the horizontal axis across its beam; its azimuth and range stay.
void raise(Sweep& sweep, double angle_deg) noexcept {
  if (angle_deg == 0.0) return;
  const double angle_rad = angle_deg * kDegree;
  const auto cosine = static_cast<float>(std::cos(angle_rad)), sine = static_cast<float>(std::sin(angle_rad));
  for (std::size_t i = 0; i < sweep.size; ++i) {
    const float x = sweep.x_m[i], y = sweep.y_m[i], z = sweep.z_m[i];
    const float across = std::sqrt(x * x + y * y);
    if (across == 0.0F) continue;
    const float scale = (across * cosine - z * sine) / across;
    sweep.x_m[i] = x * scale;
    sweep.y_m[i] = y * scale;
    sweep.z_m[i] = z * cosine + across * sine;
  }
}

void set_times(Sweep& sweep, std::span<const float> turn) noexcept {
  const bool is_compensated = sweep.header.has(kCompensated);
  const auto period_ns = static_cast<double>(sweep.header.end_ns - sweep.header.start_ns);
  for (std::size_t i = 0; i < turn.size(); ++i) {
    const double offset_ns = is_compensated ? 0.0 : static_cast<double>(std::max(0.0F, turn[i])) * period_ns;
    sweep.time_offset_ns[i] = static_cast<std::int32_t>(offset_ns);
  }
}

SweepHeader header_of(const kitti::Scan& scan, bool is_compensated) noexcept {
  SweepHeader header;
  header.sequence = scan.sequence;
  header.start_ns = header.first_arrival_ns = scan.start_ns;
  header.end_ns = header.last_arrival_ns = scan.end_ns;
  header.num_columns = header.firings_received = kKittiColumns;
  header.rotation_rev = 1.0F;
  header.flags = (is_compensated ? kCompensated : 0U) | (scan.is_after_gap ? kAfterGap : 0U);
  return header;
}

/// The end of a recording may come in the middle of a rotation.
void mark_if_cut_short(SweepHeader& header, std::span<const float> turn) noexcept {
  header.rotation_rev = std::max(0.0F, *std::ranges::max_element(turn));
  if (header.rotation_rev < 0.9F) header.flags |= kPartialEnd;
}

}  // namespace

struct KittiSource::State {
  State(const std::filesystem::path& path, const KittiConfig& settings, const SelfFilter& self)
      : folder(kitti::open_folder(path, settings)),
        is_compensated(settings.compensated == KittiCompensation::kAuto
                           ? !folder.is_raw
                           : settings.compensated == KittiCompensation::kYes),
        vertical_correction_deg(settings.vertical_correction_deg),
        reader(kMaxPoints),
        organizer(kMaxPoints, self) {}

  kitti::Folder folder;
  bool is_compensated;
  double vertical_correction_deg;
  kitti::ScanReader reader;
  ScanOrganizer organizer;

  std::size_t next = 0;  // in folder.scans; stays on the one with a fault
  kitti::ScanFault fault;
};

KittiSource::KittiSource(const std::filesystem::path& folder,
                         const KittiConfig& config,
                         const SelfFilter& self)
    : state_(std::make_unique<State>(folder, config, self)) {}

KittiSource::~KittiSource() = default;

bool KittiSource::fill(Sweep& sweep) noexcept {
  State& state = *state_;
  if (state.next == state.folder.scans.size() || state.fault.kind != kitti::ScanFault::Kind::kNone)
    return false;
  const kitti::Scan& scan = state.folder.scans[state.next];
  const std::span<const FilePoint> points =
      state.reader.read(scan.path.c_str(), sweep.capacity(), state.fault);
  if (points.empty()) return false;
  const bool is_labelled = !scan.label_path.empty();
  if (is_labelled &&
      !kitti::read_labels(scan.label_path.c_str(), sweep.label.first(points.size()), state.fault))
    return false;
  ++state.next;

  sweep.header = header_of(scan, state.is_compensated);
  sweep.header.flags |= is_labelled ? kLabelled : 0U;
  copy_points(points, sweep);
  state.organizer.organize(sweep);
  const std::span<const float> turn = state.organizer.turn_rev();
  if (state.folder.is_raw && scan.is_last_of_folder) mark_if_cut_short(sweep.header, turn);
  set_times(sweep, turn);
  raise(sweep, state.vertical_correction_deg);
  return true;
}

std::string KittiSource::first_without_labels() const {
  const auto& scans = state_->folder.scans;
  const auto found = std::ranges::find_if(scans, &std::string::empty, &kitti::Scan::label_path);
  return found == scans.end() ? std::string() : found->path;
}

Progress KittiSource::progress() const noexcept {
  return {static_cast<double>(state_->next), static_cast<double>(state_->folder.scans.size())};
}

std::string KittiSource::complaint() const {
  const State& state = *state_;
  if (state.fault.kind == kitti::ScanFault::Kind::kNone) return {};
  const kitti::Scan& scan = state.folder.scans[state.next];
  return describe(state.fault, state.fault.is_of_labels ? scan.label_path : scan.path);
}

bool KittiSource::is_compensated() const noexcept {
  return state_->is_compensated;
}
bool KittiSource::has_stamps() const noexcept {
  return state_->folder.has_stamps;
}
std::uint64_t KittiSource::missing_scans() const noexcept {
  const auto& scans = state_->folder.scans;
  return scans.back().sequence + 1 - scans.size();
}
std::uint64_t KittiSource::scans_with_guessed_rings() const noexcept {
  return state_->organizer.scans_with_guessed_rings();
}
std::uint64_t KittiSource::self_hits() const noexcept {
  return state_->organizer.self_hits();
}
std::uint64_t KittiSource::returns_without_cell() const noexcept {
  return state_->organizer.returns_without_cell();
}

}  // namespace pago
