// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "pago/output/map_writer.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "pago/core/deskew.hpp"
#include "pago/core/error.hpp"
#include "pago/core/text.hpp"
#include "pago/output/text_file.hpp"

namespace pago::output {

namespace {

constexpr int kTileBits = 9;  // voxels a side; in height 14 bits, after which they repeat
constexpr std::size_t kBlockPoints = 65'536;
constexpr const char* kTileFolder = "map_tiles";

int floor_to_int(float x) noexcept {
  return static_cast<int>(std::floor(x));
}

}  // namespace

MapWriter::MapWriter(std::filesystem::path folder, const SavedMapConfig& config)
    : folder_(std::move(folder)),
      per_voxel_(static_cast<float>(1.0 / config.voxel_m)),
      max_resident_(static_cast<std::size_t>(config.max_points_in_memory)) {}

MapWriter::~MapWriter() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_ / kTileFolder, ignored);
}

void MapWriter::add(const MapSweep& sweep) {
  ++num_keyframes_;
  const Deskew to_reference(sweep.twist);
  for (std::uint32_t i = 0; i < sweep.size; ++i) {
    const Eigen::Vector3f p = to_reference({sweep.x_m[i], sweep.y_m[i], sweep.z_m[i]}, sweep.before_s[i]);
    const Eigen::Vector3f at = (sweep.T_odom_reference * p.cast<double>()).cast<float>();
    if (at.allFinite()) add({at.x(), at.y(), at.z(), sweep.intensity[i], sweep.ground[i]});
  }
  if (num_resident_ > max_resident_) make_room();
}

void MapWriter::add(const PlyPoint& point) {
  const int x = floor_to_int(point.x_m * per_voxel_), y = floor_to_int(point.y_m * per_voxel_);
  Tile& tile = visit({x >> kTileBits, y >> kTileBits});
  if (!tile.voxels.insert(voxel_of(point)).second) return;
  tile.points.push_back(point);
  ++num_points_, ++num_resident_;
}

/// A voxel's number within its tile.
std::uint32_t MapWriter::voxel_of(const PlyPoint& point) const noexcept {
  constexpr std::uint32_t kSideMask = (1U << kTileBits) - 1, kHeightMask = (1U << (32 - 2 * kTileBits)) - 1;
  const auto part = [&](float x_m, std::uint32_t mask) {
    return static_cast<std::uint32_t>(floor_to_int(x_m * per_voxel_)) & mask;
  };
  return part(point.x_m, kSideMask) << (32 - kTileBits) | part(point.y_m, kSideMask) << (32 - 2 * kTileBits) |
         part(point.z_m, kHeightMask);
}

// Neighbouring returns are of the same tile, more often than not.
MapWriter::Tile& MapWriter::visit(const Corner& corner) {
  if (newest_ == nullptr || newest_corner_ != corner) {
    newest_corner_ = corner;
    newest_ = &tiles_[corner];
    if (!newest_->is_resident) load(corner, *newest_);
  }
  newest_->last_use = num_keyframes_;
  return *newest_;
}

/// Calls use(bytes) with all that is in the tile's file, a block at a time; false if that cannot be read.
template <typename Use>
bool MapWriter::read(const Corner& corner, const Tile& tile, Use use) const {
  if (tile.num_in_file == 0) return true;
  std::string bytes;
  std::ifstream file(file_of(corner), std::ios::binary);
  for (std::uint64_t left = tile.num_in_file; left > 0;) {
    const std::size_t count = std::min<std::uint64_t>(left, kBlockPoints);
    bytes.resize(count * kPlyPointBytes);
    if (!file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()))) return false;
    use(bytes);
    left -= count;
  }
  return true;
}

void MapWriter::load(const Corner& corner, Tile& tile) {
  tile.is_resident = true;
  const bool is_whole = read(corner, tile, [&](const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size(); at += kPlyPointBytes)
      tile.voxels.insert(voxel_of(ply_point(bytes.data() + at)));
  });
  if (!is_whole)
    complain(file_of(corner).string() + ": cannot be read back: points there are lost or doubled");
  num_resident_ += tile.voxels.size();
}

// Down to half, so that it happens now and then and not with every keyframe. Tiles of this very one stay.
void MapWriter::make_room() {
  std::vector<std::pair<std::uint64_t, Corner>> by_use;
  for (const auto& [corner, tile] : tiles_)
    if (tile.is_resident && tile.last_use < num_keyframes_) by_use.emplace_back(tile.last_use, corner);
  std::sort(by_use.begin(), by_use.end());
  for (const auto& [use, corner] : by_use) {
    if (2 * num_resident_ <= max_resident_) break;
    store(corner, tiles_[corner]);
  }
}

void MapWriter::store(const Corner& corner, Tile& tile) {
  num_resident_ -= tile.voxels.size();
  std::string bytes;
  for (const PlyPoint& point : tile.points) append(bytes, point);
  std::error_code fault;
  std::filesystem::create_directories(folder_ / kTileFolder, fault);
  std::ofstream file(file_of(corner), std::ios::binary | std::ios::app);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush();
  if (file) {
    tile.num_in_file += tile.points.size();
  } else {
    num_points_ -= tile.points.size();
    complain(file_of(corner).string() + ": cannot be written: points there are missing from the map");
  }
  tile.points = {};
  tile.voxels = {};
  tile.is_resident = false;
  newest_ = nullptr;
}

void MapWriter::write(const std::string& name) {
  replace_file(folder_ / name, [this](const std::filesystem::path& unfinished) { write_to(unfinished); });
}

void MapWriter::write_to(const std::filesystem::path& file) {
  TextFile out(file);
  out.write(map_header(num_points_));
  std::string bytes;
  for (const auto& [corner, tile] : tiles_) {
    if (!read(corner, tile, [&](const std::string& stored) { out.write(stored); }))
      throw Error(file_of(corner).string(), "cannot be read back: the map is not written");
    bytes.clear();
    for (const PlyPoint& point : tile.points) append(bytes, point);
    out.write(bytes);
  }
  out.flush();
  out.throw_if_incomplete();
}

void MapWriter::clear() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_ / kTileFolder, ignored);
  tiles_.clear();
  newest_ = nullptr;
  num_resident_ = 0;
  num_points_ = num_keyframes_ = 0;
}

std::filesystem::path MapWriter::file_of(const Corner& corner) const {
  return folder_ / kTileFolder / format("%d_%d.points", corner.first, corner.second);
}

void MapWriter::complain(const std::string& why) {
  if (complaint_.empty()) complaint_ = why;
}

}  // namespace pago::output
