// SPDX-FileCopyrightText: 2026 The PaGO authors
// SPDX-License-Identifier: BSD-3-Clause
#include "embree.hpp"

#include <algorithm>
#include <new>
#include <string>

#include "pago/core/error.hpp"

namespace pago::simulator {

EmbreeDevice make_embree_device() {
  EmbreeDevice device(rtcNewDevice("threads=1,max_isa=avx2"));
  if (!device)
    throw Error("simulator", "Embree cannot be started: error " + std::to_string(rtcGetDeviceError(nullptr)));
  return device;
}

unsigned attach_mesh(RTCDevice device, RTCScene scene, const Mesh& mesh, const Eigen::Vector3d& origin) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), mesh.vertices.size()));
  auto* const triangles = static_cast<std::array<std::uint32_t, 3>*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t),
                              mesh.triangles.size()));
  if (vertices == nullptr || triangles == nullptr) throw std::bad_alloc();
  const Eigen::Vector3f shift = (mesh.origin - origin).cast<float>();
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    Eigen::Map<Eigen::Vector3f>(vertices + 3 * i) = mesh.vertices[i] + shift;
  std::ranges::copy(mesh.triangles, triangles);
  rtcCommitGeometry(geometry);
  const unsigned id = rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  return id;
}

void commit(RTCDevice device, RTCScene scene) {
  rtcCommitScene(scene);
  if (const RTCError error = rtcGetDeviceError(device); error != RTC_ERROR_NONE)
    throw Error("simulator", "Embree fails with error " + std::to_string(error));
}

}  // namespace pago::simulator
