// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/math/types.h"
#include "core/robot/mesh_bounds.h"

namespace scoria::core {

/// Triangles of a mesh file, in the frame of the link that names it.
struct TriangleMesh {
  std::vector<Vec3> points, normals;     // m; one normal per point
  std::vector<std::uint32_t> triangles;  // three indices each
};

/// Reads DAE, STL or OBJ. @returns nothing if the file cannot be read or holds no triangle.
[[nodiscard]] std::optional<TriangleMesh> LoadMesh(const std::filesystem::path& file,
                                                   const Vec3& scale);

[[nodiscard]] MeshBounds Scaled(const MeshBounds& bounds, const Vec3& scale);
[[nodiscard]] std::optional<MeshBounds> CalcMeshBounds(const std::filesystem::path& file,
                                                       const Vec3& scale);

/// The file that a URDF means: relative to the URDF, file:PATH, file://HOST/PATH, or
/// package://PACKAGE/PATH and model://MODEL/PATH, whose package or model is looked for in the
/// folders above the URDF, by name or as the folder itself. Percent escapes (%20) are decoded
/// unless a file has them in its name.
[[nodiscard]] std::filesystem::path FindMesh(const std::string& name,
                                             const std::filesystem::path& urdf);

}  // namespace scoria::core
