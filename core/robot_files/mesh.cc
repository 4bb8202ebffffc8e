// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/mesh.h"

#include <array>
#include <charconv>
#include <string_view>

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include "core/robot_files/convex_hull.h"

namespace scoria::core {
namespace {

/// What a material says of colour; nothing for the one that Assimp puts where a file has none.
MeshPart PartOf(const aiMesh& mesh, const aiMaterial& material, const std::filesystem::path& file) {
  MeshPart part{.num_points = mesh.mNumVertices, .colour = {}, .texture = {}};
  aiString name, texture;
  material.Get(AI_MATKEY_NAME, name);
  if (std::string_view(name.C_Str()) == AI_DEFAULT_MATERIAL_NAME) return part;
  aiColor4D diffuse;
  if (material.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse) == AI_SUCCESS)
    part.colour = {diffuse.r, diffuse.g, diffuse.b};
  if (material.GetTexture(aiTextureType_DIFFUSE, 0, &texture) == AI_SUCCESS)
    part.texture = FindMesh(texture.C_Str(), file);
  return part;
}

}  // namespace

std::optional<TriangleMesh> LoadMesh(const std::filesystem::path& file, const Vec3& scale) {
  Assimp::Importer importer;
  // URDF defines the frame; Collada's own up axis must not turn it.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE,
                              aiPrimitiveType_LINE | aiPrimitiveType_POINT);
  const aiScene* scene =
      importer.ReadFile(file.string(), aiProcess_Triangulate | aiProcess_GenSmoothNormals |
                                           aiProcess_SortByPType | aiProcess_PreTransformVertices);
  if (scene == nullptr) return std::nullopt;
  TriangleMesh mesh;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh& part = *scene->mMeshes[m];
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.parts.push_back(PartOf(part, *scene->mMaterials[part.mMaterialIndex], file));
    for (unsigned v = 0; v < part.mNumVertices; ++v) {
      const aiVector3D &p = part.mVertices[v], &n = part.mNormals[v];
      mesh.points.push_back(scale.cwiseProduct(Vec3(p.x, p.y, p.z)));
      mesh.normals.push_back(scale.cwiseInverse().cwiseProduct(Vec3(n.x, n.y, n.z)).normalized());
    }
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      if (face.mNumIndices != 3) continue;
      const std::array<std::size_t, 3> v = {first + face.mIndices[0], first + face.mIndices[1],
                                            first + face.mIndices[2]};
      const Vec3 across = mesh.points[v[1]] - mesh.points[v[0]];
      const Vec3 normal = across.cross(mesh.points[v[2]] - mesh.points[v[0]]).normalized();
      for (const std::size_t i : v) {
        mesh.triangles.push_back(static_cast<std::uint32_t>(i));
        if (mesh.normals[i].squaredNorm() < 0.5) mesh.normals[i] = normal;  // as STL may leave it
      }
    }
  }
  if (mesh.triangles.empty()) return std::nullopt;
  return mesh;
}

MeshBounds Scaled(const MeshBounds& bounds, const Vec3& scale) {
  const Vec3 a = scale.cwiseProduct(bounds.low), b = scale.cwiseProduct(bounds.high);
  return {a.cwiseMin(b), a.cwiseMax(b)};
}

MeshSolid Scaled(const MeshSolid& solid, const Vec3& scale) {
  MeshSolid out{Scaled(solid.bounds, scale), solid.hull};
  for (Vec3& p : out.hull) p = scale.cwiseProduct(p);
  return out;
}

namespace {

MeshBounds BoundsOf(const TriangleMesh& mesh) {
  MeshBounds bounds{mesh.points.front(), mesh.points.front()};
  for (const Vec3& p : mesh.points) {
    bounds.low = bounds.low.cwiseMin(p);
    bounds.high = bounds.high.cwiseMax(p);
  }
  return bounds;
}

}  // namespace

std::optional<MeshBounds> CalcMeshBounds(const std::filesystem::path& file, const Vec3& scale) {
  const std::optional<TriangleMesh> mesh = LoadMesh(file, scale);
  return mesh ? std::optional(BoundsOf(*mesh)) : std::nullopt;
}

std::optional<MeshSolid> CalcMeshSolid(const std::filesystem::path& file) {
  const std::optional<TriangleMesh> mesh = LoadMesh(file, Vec3::Ones());
  if (!mesh) return std::nullopt;
  return MeshSolid{BoundsOf(*mesh), ReduceToHull(mesh->points)};
}

namespace {

namespace fs = std::filesystem;

/// `%20` and its like as the bytes that they stand for.
std::string DecodePercent(const std::string& text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    unsigned byte = 0;
    const char* hex = text.data() + i + 1;
    const bool is_escape = text[i] == '%' && i + 2 < text.size() &&
                           std::from_chars(hex, hex + 2, byte, 16).ptr == hex + 2;
    out += is_escape ? static_cast<char>(byte) : text[i];
    if (is_escape) i += 2;
  }
  return out;
}

/// The path of a file: URI, without its host.
fs::path PathOfFileUri(std::string_view uri, const fs::path& folder) {
  constexpr std::string_view kFile = "file:", kHost = "//", kLocal = "//localhost/";
  uri.remove_prefix(kFile.size());
  if (uri.starts_with(kLocal)) {
    uri.remove_prefix(kLocal.size() - 1);
  } else if (uri.starts_with(kHost)) {
    uri.remove_prefix(kHost.size());
  }
  return folder / uri;
}

/// A path whose first part is a package, sought in the folders above.
fs::path FindInPackage(const fs::path& path, const fs::path& folder) {
  const fs::path package = *path.begin(), inside = path.lexically_relative(package);
  for (fs::path above = folder; above != above.root_path(); above = above.parent_path()) {
    for (const fs::path& candidate : {above / path, above / inside}) {
      if (fs::exists(candidate)) return candidate;
    }
  }
  return folder / inside;
}

fs::path FindVerbatim(const std::string& name, const fs::path& folder) {
  for (const std::string_view scheme : {"package://", "model://"}) {
    if (name.starts_with(scheme) && name.size() > scheme.size())
      return FindInPackage(name.substr(scheme.size()), folder);
  }
  return name.starts_with("file:") ? PathOfFileUri(name, folder) : folder / name;
}

}  // namespace

fs::path FindMesh(const std::string& name, const fs::path& urdf) {
  const fs::path folder = fs::absolute(urdf).parent_path();
  const fs::path verbatim = FindVerbatim(name, folder);
  return fs::exists(verbatim) ? verbatim : FindVerbatim(DecodePercent(name), folder);
}

}  // namespace scoria::core
