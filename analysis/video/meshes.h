// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "terrains/heightfield.h"

namespace scoria::analysis {

/// Triangles: per vertex position (3), normal (3) and a colour (3) that multiplies the object's.
struct MeshData {
  static constexpr std::size_t kFloatsPerVertex = 9;
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  void AddVertex(const Vec3& p, const Vec3& n, const Vec3& colour = Vec3::Ones());
};

/// Edges of 1 about the origin.
[[nodiscard]] MeshData MakeUnitBox();
/// Radius 1, height 1 along z about the origin, with caps.
[[nodiscard]] MeshData MakeUnitCylinder();
/// Radius 1.
[[nodiscard]] MeshData MakeUnitSphere();
/// The ground, in the colours of its materials, in a square around `centre`, edge 2 half_m,
/// vertices spacing_m apart.
[[nodiscard]] MeshData MakeGroundPatch(const terrains::Heightfield& ground, const Vec2& centre,
                                       double half_m, double spacing_m);

}  // namespace scoria::analysis
