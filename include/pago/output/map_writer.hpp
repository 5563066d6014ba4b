// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "pago/config/output.hpp"
#include "pago/output/map_sweep.hpp"
#include "pago/output/ply.hpp"

namespace pago::output {

/// The saved map: all keyframes' points, moved to one instant and into `odom`, the first in each voxel.
/// However long the drive, memory stays bounded: the plane is cut into tiles of 512 voxels a side, and those
/// that were not visited for longest wait on the disk (map_tiles/) while others need the room. [publisher
/// thread] blocks on the disk. The file depends on the sweeps alone.
class MapWriter {
 public:
  /// Makes nothing on the disk before there is a need.
  MapWriter(std::filesystem::path folder, const SavedMapConfig& config);
  /// Removes map_tiles/: whoever wants the map calls write() before.
  ~MapWriter();
  MapWriter(const MapWriter&) = delete;
  MapWriter& operator=(const MapWriter&) = delete;

  void add(const MapSweep& sweep);

  /// Writes all points so far, tile by tile, as a binary PLY (output/ply.hpp) of this name into the folder; a
  /// file that is there already is replaced when the new one is whole. May be called again. Error when it
  /// cannot be written.
  void write(const std::string& name);

  /// `odom` begins anew: what comes now has nothing to do with what came before.
  void clear();

  std::uint64_t num_points() const noexcept { return num_points_; }
  std::uint64_t num_keyframes() const noexcept { return num_keyframes_; }
  /// Why points are missing; empty if none are.
  const std::string& complaint() const noexcept { return complaint_; }

 private:
  using Corner = std::pair<int, int>;  // in tiles
  struct Tile {
    std::vector<PlyPoint> points;              // those that are not in the tile's file
    std::unordered_set<std::uint32_t> voxels;  // of all its points; empty while it waits on the disk
    std::uint64_t num_in_file = 0;
    std::uint64_t last_use = 0;  // the keyframe
    bool is_resident = true;
  };

  void add(const PlyPoint& point);
  void write_to(const std::filesystem::path& file);
  Tile& visit(const Corner& corner);
  void load(const Corner& corner, Tile& tile);
  void make_room();
  void store(const Corner& corner, Tile& tile);
  template <typename Use>
  bool read(const Corner& corner, const Tile& tile, Use use) const;
  std::uint32_t voxel_of(const PlyPoint& point) const noexcept;
  std::filesystem::path file_of(const Corner& corner) const;
  void complain(const std::string& why);

  std::filesystem::path folder_;
  float per_voxel_;
  std::size_t max_resident_, num_resident_ = 0;
  std::map<Corner, Tile> tiles_;  // in the order in which they are written
  Corner newest_corner_{};
  Tile* newest_ = nullptr;
  std::uint64_t num_points_ = 0, num_keyframes_ = 0;
  std::string complaint_;
};

}  // namespace pago::output
