// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "folder.hpp"

#include <algorithm>
#include <charconv>
#include <optional>

#include "pago/core/error.hpp"
#include "pago/kitti/kitti_source.hpp"
#include "stamps.hpp"

namespace pago::kitti {
namespace {

namespace fs = std::filesystem;

struct NumberedFile {
  std::uint64_t number;
  fs::path path;
};

/// Where scans, stamps and labels lie.
struct Layout {
  fs::path scans, stamps;
  std::vector<fs::path> labels;
  bool is_raw = false;
};

std::optional<std::uint64_t> scan_number(const fs::path& file) {
  const std::string stem = file.stem().string();
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (file.extension() != ".bin" || error != std::errc{} || end != stem.data() + stem.size())
    return std::nullopt;
  return number;
}

std::vector<NumberedFile> find_scans(const fs::path& folder) {
  std::vector<NumberedFile> files;
  std::error_code not_a_folder;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, not_a_folder))
    if (const auto number = scan_number(entry.path())) files.push_back({*number, entry.path()});
  std::ranges::sort(files, {}, &NumberedFile::number);
  return files;
}

std::vector<Layout> possible_layouts(const fs::path& folder) {
  const fs::path parent = folder.parent_path();
  std::error_code unknown;
  const bool has_dates = fs::exists(parent / "timestamps.txt", unknown);
  return {
      {folder / "velodyne", folder / "times.txt", {folder / "labels"}, false},
      {folder / "velodyne_points" / "data",
       folder / "velodyne_points" / "timestamps.txt",
       {folder / "labels", folder / "velodyne_points" / "labels"},
       true},
      {folder / "data", folder / "timestamps.txt", {folder / "labels", parent / "labels"}, true},
      {folder,
       parent / (has_dates ? "timestamps.txt" : "times.txt"),
       {parent / "labels", parent.parent_path() / "labels"},
       has_dates},
  };
}

/// SemanticKITTI's labels of a scan: a file of the same number; empty if there is none.
std::string find_labels(const fs::path& scan, const Layout& layout) {
  std::error_code unknown;
  for (const fs::path& folder : layout.labels) {
    const fs::path file = folder / scan.stem().replace_extension(".label");
    if (fs::exists(file, unknown)) return file.string();
  }
  return {};
}

/// The stamp of each file: by its number where the stamps reach that far, else one by one.
std::vector<std::size_t> match_stamps(const std::vector<NumberedFile>& files,
                                      const fs::path& stamp_file,
                                      std::size_t num_stamps) {
  const bool by_number = files.back().number < num_stamps;
  if (!by_number && files.size() != num_stamps)
    throw Error(stamp_file.string(),
                "has " + std::to_string(num_stamps) + " stamps, but the folder has " +
                    std::to_string(files.size()) + " scans up to number " +
                    std::to_string(files.back().number),
                "take the stamp file that belongs to these scans");
  std::vector<std::size_t> index(files.size());
  for (std::size_t i = 0; i < files.size(); ++i) index[i] = by_number ? files[i].number : i;
  return index;
}

/// Start and end of each file's rotation.
void set_times(const std::vector<NumberedFile>& files, const Layout& layout, Folder& folder) {
  folder.has_stamps = fs::exists(layout.stamps);
  std::vector<std::int64_t> stamps_ns;
  std::vector<std::size_t> index;
  if (folder.has_stamps) {
    stamps_ns = layout.is_raw ? read_dates(layout.stamps) : read_seconds(layout.stamps);
    index = match_stamps(files, layout.stamps, stamps_ns.size());
  }
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto number = static_cast<std::int64_t>(i == 0 ? 0 : files[i].number - files[0].number);
    const std::int64_t mid_ns =
        folder.has_stamps ? stamps_ns[index[i]] : kKittiEpochNs + number * kNominalPeriodNs;
    const std::int64_t period = folder.has_stamps ? period_ns(stamps_ns, index[i]) : kNominalPeriodNs;
    folder.scans[i].start_ns = mid_ns - period / 2;
    folder.scans[i].end_ns = folder.scans[i].start_ns + period;
  }
}

/// Keeps what `first` and `count` ask for.
void select(const KittiConfig& config, const fs::path& path, Folder& folder) {
  const auto first = static_cast<std::size_t>(std::max(0, config.first));
  if (first >= folder.scans.size())
    throw Error("kitti.first", std::to_string(config.first) + " leaves no scan",
                path.string() + " has " + std::to_string(folder.scans.size()));
  auto& scans = folder.scans;
  scans.erase(scans.begin(), scans.begin() + static_cast<std::ptrdiff_t>(first));
  if (config.count > 0) scans.resize(std::min(scans.size(), static_cast<std::size_t>(config.count)));
  const std::uint64_t offset = scans.front().sequence;
  for (Scan& scan : scans) scan.sequence -= offset;
  scans.front().is_after_gap = false;
}

Folder read_layout(const Layout& layout, const std::vector<NumberedFile>& files, bool with_labels) {
  Folder folder;
  folder.is_raw = layout.is_raw;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const std::uint64_t number = files[i].number;
    if (i > 0 && number == files[i - 1].number)
      throw Error(files[i].path.string(), "has the same number as " + files[i - 1].path.filename().string(),
                  "keep one of them");
    folder.scans.push_back({.path = files[i].path.string(),
                            .label_path = with_labels ? find_labels(files[i].path, layout) : std::string(),
                            .sequence = number,
                            .is_after_gap = i > 0 && number != files[i - 1].number + 1,
                            .is_last_of_folder = i + 1 == files.size()});
  }
  set_times(files, layout, folder);
  return folder;
}

}  // namespace

Folder open_folder(const fs::path& folder, const KittiConfig& config) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) throw Error(folder.string(), "does not exist", "check the path");
  if (!fs::is_directory(folder, ignored))
    throw Error(folder.string(), "is not a folder", "give the folder of a KITTI sequence, not a file in it");
  fs::path clean = fs::absolute(folder).lexically_normal();
  if (!clean.has_filename()) clean = clean.parent_path();

  for (const Layout& layout : possible_layouts(clean)) {
    const std::vector<NumberedFile> files = find_scans(layout.scans);
    if (files.empty()) continue;
    Folder found = read_layout(layout, files, config.labels);
    select(config, folder, found);
    return found;
  }
  throw Error(
      folder.string(), "holds no KITTI scans",
      "expected numbered .bin files in velodyne/ (odometry benchmark) or velodyne_points/data/ (raw)");
}

}  // namespace pago::kitti
