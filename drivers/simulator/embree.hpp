// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <embree3/rtcore.h>

#include <memory>

#include "mesh.hpp"

/// What the two users of Embree share. [set-up] everything.
namespace pago::simulator {

struct ReleaseEmbree {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using EmbreeDevice = std::unique_ptr<RTCDeviceTy, ReleaseEmbree>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, ReleaseEmbree>;

/// One thread, so that trees of boxes are always built the same way; an instruction set that today's machines
/// share, since others round differently. Throws Error.
EmbreeDevice make_embree_device();
/// Adds a mesh, its vertices about `origin`; returns its number in the scene.
unsigned attach_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh, const Eigen::Vector3d& origin);
/// Makes the scene ready for rays; throws Error if anything failed since the last call.
void commit(RTCDevice device, RTCScene scene);

/// A query for one ray of which nothing is known yet.
inline RTCRayHit one_ray(const Eigen::Vector3f& from,
                         const Eigen::Vector3f& way,
                         float near_m,
                         float far_m) noexcept {
  RTCRayHit query{};
  query.ray = {from.x(), from.y(), from.z(), near_m, way.x(), way.y(), way.z(), 0.0F, far_m, ~0U, 0U, 0U};
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

}  // namespace pago::simulator
