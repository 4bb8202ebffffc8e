// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/math/types.h"

namespace scoria::core {

/// Triangles of a mesh file, in the frame of the link that names it.
struct TriangleMesh {
  std::vector<Vec3> points, normals;     // m; one normal per point
  std::vector<std::uint32_t> triangles;  // three indices each
};

/// Reads DAE, STL or OBJ. @returns nothing if the file cannot be read or holds no triangle.
[[nodiscard]] std::optional<TriangleMesh> LoadMesh(const std::filesystem::path& file,
                                                   const Vec3& scale);

struct MeshBounds {
  Vec3 low, high;
};

/// What a log keeps of a mesh file: the box around it, without the URDF's scale, and Hash64 of its
/// content.
struct MeshRecord {
  MeshBounds bounds{Vec3::Zero(), Vec3::Zero()};
  std::uint64_t hash = 0;
};
/// By the name that the URDF gives the file.
using MeshRecords = std::map<std::string, MeshRecord>;

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
