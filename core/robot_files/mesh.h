// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/types.h"
#include "core/robot/mesh_bounds.h"

namespace scoria::core {

/// Points of a mesh that follow each other and share a material.
struct MeshPart {
  std::size_t num_points = 0;
  std::optional<std::array<float, 3>> colour;  // diffuse, red, green, blue in [0, 1]
  std::filesystem::path texture;               // over the colour; empty: none
};

/// Triangles of a mesh file, in the frame of the link that names it.
struct TriangleMesh {
  std::vector<Vec3> points, normals;     // m; one normal per point
  std::vector<std::uint32_t> triangles;  // three indices each
  std::vector<MeshPart> parts;           // all points in order; no colour where the file has none
};

/// Reads DAE, STL or OBJ. @returns nothing if the file cannot be read or holds no triangle.
[[nodiscard]] std::optional<TriangleMesh> LoadMesh(const std::filesystem::path& file,
                                                   const Vec3& scale);

/// What of a mesh can collide, m: the box around it, and its convex hull by few points.
struct MeshSolid {
  MeshBounds bounds;
  std::vector<Vec3> hull;
};

[[nodiscard]] MeshBounds Scaled(const MeshBounds& bounds, const Vec3& scale);
[[nodiscard]] MeshSolid Scaled(const MeshSolid& solid, const Vec3& scale);
[[nodiscard]] std::optional<MeshBounds> CalcMeshBounds(const std::filesystem::path& file,
                                                       const Vec3& scale);
/// Without the URDF's scale.
[[nodiscard]] std::optional<MeshSolid> CalcMeshSolid(const std::filesystem::path& file);

/// The file that a URDF means: relative to the URDF, file:PATH, file://HOST/PATH, or
/// package://PACKAGE/PATH and model://MODEL/PATH, whose package or model is looked for in the
/// folders above the URDF, by name or as the folder itself. Percent escapes (%20) are decoded
/// unless a file has them in its name.
[[nodiscard]] std::filesystem::path FindMesh(const std::string& name,
                                             const std::filesystem::path& urdf);

}  // namespace scoria::core
