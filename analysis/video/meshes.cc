// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/video/meshes.h"

#include <cmath>
#include <numbers>

#include "analysis/terrain/ground_colour.h"

namespace scoria::analysis {
namespace {

constexpr double kPi = std::numbers::pi;

/// Two triangles for each cell of a columns x rows lattice of vertices that starts at `first`.
void AddLattice(MeshData& mesh, std::uint32_t first, std::uint32_t columns, std::uint32_t rows) {
  for (std::uint32_t r = 0; r + 1 < rows; ++r) {
    for (std::uint32_t c = 0; c + 1 < columns; ++c) {
      const std::uint32_t i = first + r * columns + c;
      mesh.indices.insert(mesh.indices.end(),
                          {i, i + 1, i + columns, i + 1, i + columns + 1, i + columns});
    }
  }
}

}  // namespace

void MeshData::AddVertex(const Vec3& p, const Vec3& n, const Vec3& colour) {
  for (const Vec3& v : {p, n, colour}) {
    for (int i = 0; i < 3; ++i) vertices.push_back(static_cast<float>(v[i]));
  }
}

MeshData MakeUnitBox() {
  MeshData mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 n = sign * Vec3::Unit(axis), u = Vec3::Unit((axis + 1) % 3),
                 v = Vec3::Unit((axis + 2) % 3);
      const auto first =
          static_cast<std::uint32_t>(mesh.vertices.size() / MeshData::kFloatsPerVertex);
      for (const double a : {-0.5, 0.5}) {
        for (const double b : {-0.5, 0.5}) mesh.AddVertex(0.5 * n + a * u + b * v, n);
      }
      AddLattice(mesh, first, 2, 2);
    }
  }
  return mesh;
}

MeshData MakeUnitCylinder() {
  constexpr std::uint32_t kSides = 20;
  MeshData mesh;
  const auto rim = [](std::uint32_t k) {
    const double angle = 2.0 * kPi * k / kSides;
    return Vec3(std::cos(angle), std::sin(angle), 0.0);
  };
  for (const double z : {-0.5, 0.5}) {
    for (std::uint32_t k = 0; k <= kSides; ++k) mesh.AddVertex(rim(k) + Vec3(0, 0, z), rim(k));
  }
  AddLattice(mesh, 0, kSides + 1, 2);
  for (const double z : {-0.5, 0.5}) {
    const Vec3 n(0.0, 0.0, z > 0.0 ? 1.0 : -1.0);
    const auto centre =
        static_cast<std::uint32_t>(mesh.vertices.size() / MeshData::kFloatsPerVertex);
    mesh.AddVertex(Vec3(0, 0, z), n);
    for (std::uint32_t k = 0; k <= kSides; ++k) mesh.AddVertex(rim(k) + Vec3(0, 0, z), n);
    for (std::uint32_t k = 1; k <= kSides; ++k)
      mesh.indices.insert(mesh.indices.end(), {centre, centre + k, centre + k + 1});
  }
  return mesh;
}

MeshData MakeUnitSphere() {
  constexpr std::uint32_t kColumns = 21, kRows = 12;
  MeshData mesh;
  for (std::uint32_t r = 0; r < kRows; ++r) {
    for (std::uint32_t c = 0; c < kColumns; ++c) {
      const double polar = kPi * r / (kRows - 1.0), azimuth = 2.0 * kPi * c / (kColumns - 1.0);
      const Vec3 n(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth),
                   std::cos(polar));
      mesh.AddVertex(n, n);
    }
  }
  AddLattice(mesh, 0, kColumns, kRows);
  return mesh;
}

MeshData MakeGroundPatch(const terrains::Heightfield& ground, const Vec2& centre, double half_m,
                         double spacing_m) {
  const auto n = static_cast<std::uint32_t>(std::lround(2.0 * half_m / spacing_m)) + 1;
  MeshData mesh;
  for (std::uint32_t r = 0; r < n; ++r) {
    for (std::uint32_t c = 0; c < n; ++c) {
      const double x = centre.x() - half_m + c * spacing_m, y = centre.y() - half_m + r * spacing_m;
      const auto s = ground.At(x, y);
      mesh.AddVertex(Vec3(x, y, s.z_m), Vec3(-s.gradient.x(), -s.gradient.y(), 1.0).normalized(),
                     GroundColour(ground, {x, y}));
    }
  }
  AddLattice(mesh, 0, n, n);
  return mesh;
}

}  // namespace scoria::analysis
