// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <urdf_model/link.h>

#include "core/robot/description.h"
#include "core/robot_files/mesh.h"
#include "core/robot_files/urdf_pose.h"

namespace scoria::core {

/// Reads what a URDF's links collide as and look like into a robot's shapes. A mesh that collides
/// becomes its convex hull. Where its file is lost, the link's visuals stand for it, meshes among
/// them as boxes; without those the link does not collide. Warnings of the robot say so.
class UrdfShapes {
 public:
  /// `robot` has its config and mesh records; it is borrowed.
  explicit UrdfShapes(RobotDescription& robot) : robot_(robot) {}

  /// @param foot_of  the leg whose foot the link is, if any: its first sphere is the foot, or the
  ///                 sphere of the robot's YAML, which stands for whatever the link collides as.
  void Add(const urdf::Link& link, int body, const UrdfPose& X_L, LegDescription* foot_of);

  /// After all links: one whose visual meshes are all lost, and a body without visuals, are drawn
  /// as they collide; and the robot is given its warnings and remarks.
  void Finish();

 private:
  void AddCollision(Shape shape, LegDescription* foot_of);
  void AddMeshCollision(const urdf::Link& link, const Shape& mesh, const UrdfPose& X_L,
                        LegDescription* foot_of);
  void AddSubstitute(const urdf::Link& link, const Shape& lost, const UrdfPose& X_L,
                     LegDescription* foot_of);
  void AddVisuals(const urdf::Link& link, int body, const UrdfPose& X_L);
  [[nodiscard]] Shape ToShape(const urdf::Geometry& geometry, const std::string& link, int body,
                              const UrdfPose& X_G) const;
  void DrawBareLinks();

  /// Box and hull of a mesh's file, or as the log recorded them; scaled.
  [[nodiscard]] std::optional<MeshSolid> SolidOf(const Shape& mesh);

  /// Links with what is to be said of each.
  using Notes = std::vector<std::pair<std::string, std::string>>;

  RobotDescription& robot_;
  Notes warnings_, remarks_;
  std::vector<Shape> drawable_;  // collision shapes that can be drawn, as the URDF has them
  std::map<std::string, std::string> lost_;  // links without their visuals, and a file of each
  std::map<std::filesystem::path, std::optional<MeshSolid>> solids_;
};

}  // namespace scoria::core
