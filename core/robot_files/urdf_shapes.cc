// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/urdf_shapes.h"

#include <array>

#include <fmt/format.h>

namespace scoria::core {
namespace {

/// A mesh as the box around it.
Shape AsBox(const Shape& mesh, const MeshBounds& bounds) {
  Shape box = mesh;
  box.kind = Shape::Kind::kBox;
  box.size_m = bounds.high - bounds.low;
  box.p_LG = mesh.p_LG + mesh.R_LG * (0.5 * (bounds.low + bounds.high));
  return box;
}

/// A mesh as its convex hull; as its box where a log has no hull, or it is flat.
Shape AsHull(const Shape& mesh, const MeshSolid& solid) {
  constexpr std::size_t kFewest = 4;
  Shape hull = AsBox(mesh, solid.bounds);
  if (solid.hull.size() < kFewest) return hull;
  hull.kind = Shape::Kind::kHull;
  const Vec3 centre = 0.5 * (solid.bounds.low + solid.bounds.high);
  for (const Vec3& p : solid.hull) hull.hull.push_back(p - centre);
  return hull;
}

std::string_view KindName(Shape::Kind kind) {
  switch (kind) {
    case Shape::Kind::kCylinder:
      return "cylinder";
    case Shape::Kind::kSphere:
      return "sphere";
    default:
      return "box";
  }
}

/// One sentence for all links of which the same is to be said.
std::vector<std::string> Grouped(const std::vector<std::pair<std::string, std::string>>& notes) {
  std::map<std::string, std::vector<std::string>> links;
  for (const auto& [link, text] : notes) links[text].push_back(link);
  std::vector<std::string> out;
  for (const auto& [text, names] : links)
    out.push_back(fmt::format("{}: {}", fmt::join(names, ", "), text));
  return out;
}

}  // namespace

void UrdfShapes::Add(const urdf::Link& link, int body, const UrdfPose& X_L,
                     LegDescription* foot_of) {
  const double foot_radius_m = robot_.config.foot_radius_m;
  if (foot_of != nullptr && foot_radius_m > 0.0) {
    Shape sphere;
    sphere.kind = Shape::Kind::kSphere;
    sphere.body = body;
    sphere.link = link.name;
    sphere.size_m = {foot_radius_m, 0.0, 0.0};
    sphere.p_LG = X_L.p;
    AddCollision(sphere, foot_of);
  } else {
    for (const auto& collision : link.collision_array) {
      if (!collision->geometry) continue;
      const Shape shape = ToShape(*collision->geometry, link.name, body, X_L * collision->origin);
      if (shape.kind == Shape::Kind::kMesh) {
        AddMeshCollision(link, shape, X_L, foot_of);
      } else {
        AddCollision(shape, foot_of);
      }
    }
  }
  AddVisuals(link, body, X_L);
}

void UrdfShapes::AddCollision(Shape shape, LegDescription* foot_of) {
  if (foot_of != nullptr && shape.kind == Shape::Kind::kSphere && foot_of->foot_radius_m == 0.0) {
    shape.is_foot = true;
    foot_of->p_LF = shape.p_LG;
    foot_of->foot_radius_m = shape.size_m.x();
  }
  robot_.collisions.push_back(shape);
  drawable_.push_back(shape);
}

void UrdfShapes::AddMeshCollision(const urdf::Link& link, const Shape& mesh, const UrdfPose& X_L,
                                  LegDescription* foot_of) {
  const std::optional<MeshSolid> solid = SolidOf(mesh);
  if (!solid) {
    AddSubstitute(link, mesh, X_L, foot_of);
    return;
  }
  robot_.collisions.push_back(AsHull(mesh, *solid));
  drawable_.push_back(mesh);
}

void UrdfShapes::AddSubstitute(const urdf::Link& link, const Shape& lost, const UrdfPose& X_L,
                               LegDescription* foot_of) {
  std::vector<std::string> names;
  for (const auto& visual : link.visual_array) {
    if (!visual->geometry) continue;
    const Shape shape = ToShape(*visual->geometry, link.name, lost.body, X_L * visual->origin);
    if (shape.kind != Shape::Kind::kMesh) {
      names.push_back(fmt::format("the {} that it looks like", KindName(shape.kind)));
      AddCollision(shape, foot_of);
    } else if (const std::optional<MeshSolid> solid = SolidOf(shape)) {
      names.push_back(fmt::format("the box around {}", shape.mesh.filename().string()));
      AddCollision(AsBox(shape, solid->bounds), foot_of);
    }
  }
  robot_.warnings.push_back(
      fmt::format("{}: collision mesh {} cannot be read; {}", link.name, lost.mesh.string(),
                  names.empty() ? "the link does not collide"
                                : fmt::format("the link collides as {}", fmt::join(names, ", "))));
}

void UrdfShapes::AddVisuals(const urdf::Link& link, int body, const UrdfPose& X_L) {
  bool is_drawn = false;
  for (const auto& visual : link.visual_array) {
    if (!visual->geometry) continue;
    Shape shape = ToShape(*visual->geometry, link.name, body, X_L * visual->origin);
    if (visual->material) {
      const urdf::Color& c = visual->material->color;
      shape.colour = {c.r, c.g, c.b};
    }
    if (shape.kind == Shape::Kind::kMesh && !robot_.meshes.contains(shape.mesh_name) &&
        !std::filesystem::exists(shape.mesh)) {
      lost_.try_emplace(link.name, shape.mesh.string());
      continue;
    }
    is_drawn = true;
    robot_.visuals.push_back(shape);
  }
  if (!is_drawn || !lost_.contains(link.name)) return;
  remarks_.emplace_back(link.name,
                        fmt::format("visual mesh {} is missing and not drawn", lost_[link.name]));
  lost_.erase(link.name);
}

void UrdfShapes::DrawBareLinks() {
  std::array<bool, kNumBodies> has_visuals{};
  for (const Shape& shape : robot_.visuals)
    has_visuals[static_cast<std::size_t>(shape.body)] = true;
  std::set<std::string> drawn;
  for (const Shape& shape : drawable_) {
    if (!lost_.contains(shape.link) && has_visuals[static_cast<std::size_t>(shape.body)]) continue;
    robot_.visuals.push_back(shape);
    drawn.insert(shape.link);
  }
  for (const auto& [link, file] : lost_) {
    remarks_.emplace_back(link,
                          fmt::format("visual mesh {} is missing; the link is {}", file,
                                      drawn.contains(link) ? "drawn as it collides" : "not drawn"));
  }
}

void UrdfShapes::Finish() {
  DrawBareLinks();
  for (std::string& text : Grouped(warnings_)) robot_.warnings.push_back(std::move(text));
  for (std::string& text : Grouped(remarks_)) robot_.remarks.push_back(std::move(text));
}

Shape UrdfShapes::ToShape(const urdf::Geometry& geometry, const std::string& link, int body,
                          const UrdfPose& X_G) const {
  Shape shape;
  shape.body = body;
  shape.link = link;
  shape.p_LG = X_G.p;
  shape.R_LG = X_G.R;
  if (geometry.type == urdf::Geometry::BOX) {
    shape.kind = Shape::Kind::kBox;
    shape.size_m = ToVec3(dynamic_cast<const urdf::Box&>(geometry).dim);
  } else if (geometry.type == urdf::Geometry::CYLINDER) {
    const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
    shape.kind = Shape::Kind::kCylinder;
    shape.size_m = {cylinder.radius, cylinder.length, 0.0};
  } else if (geometry.type == urdf::Geometry::SPHERE) {
    shape.kind = Shape::Kind::kSphere;
    shape.size_m = {dynamic_cast<const urdf::Sphere&>(geometry).radius, 0.0, 0.0};
  } else {
    const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
    shape.kind = Shape::Kind::kMesh;
    shape.size_m = ToVec3(mesh.scale);
    shape.mesh = FindMesh(mesh.filename, robot_.config.urdf);
    shape.mesh_name = mesh.filename;
  }
  return shape;
}

std::optional<MeshSolid> UrdfShapes::SolidOf(const Shape& mesh) {
  const auto record = robot_.meshes.find(mesh.mesh_name);
  if (record != robot_.meshes.end())
    return Scaled(MeshSolid{record->second.bounds, record->second.hull}, mesh.size_m);
  const auto [at, is_new] = solids_.try_emplace(mesh.mesh);
  if (is_new) at->second = CalcMeshSolid(mesh.mesh);
  return at->second ? std::optional(Scaled(*at->second, mesh.size_m)) : std::nullopt;
}

}  // namespace scoria::core
