// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ray_caster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

#include "embree.hpp"

namespace pago::simulator {
namespace {

constexpr double kMargin_m = 10.0;      // tiles are built this much before they can be seen
constexpr double kKeep_m = 40.0;        // and thrown away this much after
constexpr double kMaxOffset_m = 384.0;  // from the origin: 0.03 mm of rounding

struct LoadedTile {
  Tile tile;
  Mesh mesh;
  unsigned id = RTC_INVALID_GEOMETRY_ID;
};

double distance_to(const Tile& tile, const Eigen::Vector3d& place) {
  const Eigen::AlignedBox2d square(tile.corner(), tile.corner() + Eigen::Vector2d::Constant(kTile_m));
  return square.exteriorDistance(place.head<2>());
}

}  // namespace

struct RayCaster::State {
  explicit State(std::function<Mesh(const Tile&)> make)
      : make_tile(std::move(make)), device(make_embree_device()), scene(rtcNewScene(device.get())) {
    // A tree of boxes for each tile: they come and go without the others being built anew. Rays take no
    // longer for it.
    rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_LOW);
    rtcSetSceneFlags(scene.get(), static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_DYNAMIC | RTC_SCENE_FLAG_ROBUST));
  }

  void attach(LoadedTile& loaded) const {
    loaded.id = attach_mesh(device.get(), scene.get(), loaded.mesh, origin);
  }
  void detach(const LoadedTile& loaded) const { rtcDetachGeometry(scene.get(), loaded.id); }
  void load_around(const Eigen::Vector3d& place);
  void drop_far(const Eigen::Vector3d& place);
  void move_origin(const Eigen::Vector3d& place);
  Hit hit_of(float range_m, unsigned id, unsigned triangle, const Eigen::Vector3f& normal) const noexcept;

  std::function<Mesh(const Tile&)> make_tile;
  EmbreeDevice device;
  EmbreeScene scene;
  std::unordered_map<std::uint64_t, std::unique_ptr<LoadedTile>> tiles;
  std::vector<const Mesh*> mesh_of_id;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d loaded_at = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
};

void RayCaster::State::load_around(const Eigen::Vector3d& place) {
  constexpr int kReach = static_cast<int>((kSight_m + kMargin_m) / kTile_m) + 1;
  const Tile here = Tile::of(place.head<2>());
  for (int j = here.j - kReach; j <= here.j + kReach; ++j) {
    for (int i = here.i - kReach; i <= here.i + kReach; ++i) {
      const Tile tile{i, j};
      if (distance_to(tile, place) > kSight_m + kMargin_m || tiles.contains(tile.key())) continue;
      auto loaded = std::make_unique<LoadedTile>(LoadedTile{tile, make_tile(tile)});
      if (loaded->mesh.triangles.empty()) continue;
      attach(*loaded);
      tiles.emplace(tile.key(), std::move(loaded));
    }
  }
}

void RayCaster::State::drop_far(const Eigen::Vector3d& place) {
  std::erase_if(tiles, [&](auto& entry) {
    if (distance_to(entry.second->tile, place) <= kSight_m + kKeep_m) return false;
    detach(*entry.second);
    return true;
  });
}

void RayCaster::State::move_origin(const Eigen::Vector3d& place) {
  origin = (place / kTile_m).array().round().matrix() * kTile_m;
  for (auto& [key, loaded] : tiles) {
    detach(*loaded);
    attach(*loaded);
  }
}

Hit RayCaster::State::hit_of(float range_m,
                             unsigned id,
                             unsigned triangle,
                             const Eigen::Vector3f& normal) const noexcept {
  if (id == RTC_INVALID_GEOMETRY_ID) return {};
  return {range_m, normal, mesh_of_id[id]->surfaces[triangle]};
}

RayCaster::RayCaster(std::function<Mesh(const Tile&)> make_tile)
    : state_(std::make_unique<State>(std::move(make_tile))) {}

RayCaster::~RayCaster() = default;

void RayCaster::move_to(const Eigen::Vector3d& place) {
  State& state = *state_;
  if ((place - state.loaded_at).norm() < 0.5 * kMargin_m) return;
  state.loaded_at = place;
  state.drop_far(place);
  if ((place - state.origin).norm() > kMaxOffset_m) state.move_origin(place);
  state.load_around(place);
  commit(state.device.get(), state.scene.get());
  std::ranges::fill(state.mesh_of_id, nullptr);
  for (const auto& [key, loaded] : state.tiles) {
    if (state.mesh_of_id.size() <= loaded->id) state.mesh_of_id.resize(loaded->id + 1, nullptr);
    state.mesh_of_id[loaded->id] = &loaded->mesh;
  }
}

const Eigen::Vector3d& RayCaster::origin() const noexcept {
  return state_->origin;
}

void RayCaster::cast(const RayPacket& rays, std::array<Hit, RayPacket::kSize>& hits) const noexcept {
  constexpr std::size_t kSize = RayPacket::kSize;
  alignas(32) static constexpr std::array<int, kSize> kAll{-1, -1, -1, -1, -1, -1, -1, -1};
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  RTCRayHit8 query;  // NOLINT(*-member-init): every entry that Embree reads is set
  const auto copy = [](const std::array<float, kSize>& from, float* to) { std::ranges::copy(from, to); };
  copy(rays.x_m, query.ray.org_x), copy(rays.y_m, query.ray.org_y), copy(rays.z_m, query.ray.org_z);
  copy(rays.dx, query.ray.dir_x), copy(rays.dy, query.ray.dir_y), copy(rays.dz, query.ray.dir_z);
  for (std::size_t i = 0; i < kSize; ++i) {
    query.ray.tnear[i] = kNearest_m;
    query.ray.tfar[i] = static_cast<float>(kSight_m);
    query.ray.time[i] = 0.0F;
    query.ray.mask[i] = ~0U;
    query.ray.flags[i] = 0;
    query.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0][i] = RTC_INVALID_GEOMETRY_ID;
  }
  rtcIntersect8(kAll.data(), state_->scene.get(), &context, &query);
  for (std::size_t i = 0; i < kSize; ++i) {
    hits[i] = state_->hit_of(query.ray.tfar[i], query.hit.geomID[i], query.hit.primID[i],
                             {query.hit.Ng_x[i], query.hit.Ng_y[i], query.hit.Ng_z[i]});
  }
}

Hit RayCaster::cast_on(const RayPacket& rays, std::size_t index, float from_m) const noexcept {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query = one_ray(rays.foot(index), rays.way(index), from_m, static_cast<float>(kSight_m));
  rtcIntersect1(state_->scene.get(), &context, &query);
  return state_->hit_of(query.ray.tfar, query.hit.geomID, query.hit.primID,
                        {query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z});
}

std::size_t RayCaster::num_tiles() const noexcept {
  return state_->tiles.size();
}

}  // namespace pago::simulator
