// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/load.h"

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <urdf_model/model.h>

#include "core/config/node.h"
#include "core/file_kind.h"
#include "core/math/so3.h"
#include "core/robot/normalise.h"
#include "core/robot/trunk_frame.h"
#include "core/robot_files/foot_clearance.h"
#include "core/robot_files/shape_size.h"
#include "core/robot_files/urdf.h"
#include "core/robot_files/urdf_error.h"
#include "core/robot_files/urdf_tree.h"
#include "core/robot_files/xacro.h"

namespace scoria::core {
namespace {

/// Refuses shapes that cannot be of this robot, as of meshes in millimetres without scale.
void CheckShapeSizes(const RobotDescription& robot) {
  constexpr double kLargest = 10.0;
  const double size_m = RobotSize(robot);
  for (const Shape& shape : robot.collisions) {
    const double extent_m = ExtentOf(shape).maxCoeff();
    if (extent_m <= kLargest * size_m) continue;
    FailUrdf(
        robot.config, shape.link,
        fmt::format("collides as {} of {:.4g} m; a robot with {:.2f} m from hip to hip and down to "
                    "the foot may have shapes of up to {:.3g} m{}",
                    shape.mesh.empty() ? "a shape" : shape.mesh.string(), extent_m, size_m,
                    kLargest * size_m, shape.mesh.empty() ? "" : kScaleHint));
  }
}

/// Fixes a body to the trunk: its inertia, and a box to be seen. Nothing collides with it.
void Mount(const PayloadParams& params, RobotDescription& robot) {
  MergeInertia(robot.trunk, ToInertia(params));
  if (params.size_m == Vec3::Zero()) return;
  Shape box;
  box.size_m = params.size_m;
  box.p_LG = params.p_BP_m;
  box.R_LG = RotationFromRpy(params.rpy_rad);
  box.colour = {0.25f, 0.25f, 0.28f};
  robot.visuals.push_back(box);
}

}  // namespace

RobotDescription ReadRobot(const RobotConfig& config) {
  std::ifstream in(config.urdf);
  if (!in) FailUrdf(config, "urdf", "cannot read the file");
  if (std::filesystem::is_directory(config.urdf))
    FailUrdf(config, "urdf", "is a folder, not a URDF");
  std::stringstream text;
  text << in.rdbuf();
  const bool is_xacro = KindOfContent(text.str()).name == kXacro;
  return MakeRobot(config, is_xacro ? ExpandXacro(config.urdf) : text.str());
}

RobotDescription LoadRobot(const RobotConfig& config) {
  RobotDescription robot = ReadRobot(config);
  for (const Leg leg : kLegs) {
    for (const JointDescription& joint : robot.legs[leg].joints) {
      if (joint.effort_Nm <= 0.0)
        FailUrdf(config, joint.name,
                 "needs a positive effort limit, in the URDF or as limits of the robot's YAML");
    }
  }
  return robot;
}

RobotDescription MakeRobot(const RobotConfig& config, const std::string& urdf_text,
                           const MeshRecords& meshes) {
  const urdf::ModelInterfaceSharedPtr model = ParseUrdf(urdf_text, config.urdf.string());
  RobotDescription robot;
  robot.config = config;
  robot.urdf_text = urdf_text;
  robot.meshes = meshes;
  AddUrdfTree(*model, robot);
  for (int i = 0; i < kNumBodies; ++i) {
    if (robot.body(i).mass_kg <= 0.0) FailUrdf(config, robot.body(i).name, "needs a positive mass");
  }
  PlaceTrunkFrame(robot);
  const double bare_kg = robot.total_mass_kg();
  for (const PayloadParams& body : config.equipment) Mount(body, robot);
  const std::string problem = NormaliseJoints(robot);
  if (!problem.empty()) FailUrdf(config, "legs", problem);
  CheckShapeSizes(robot);
  robot.similarity = Similarity::Of(bare_kg, LegLength(robot.legs[Leg::kFL]));
  DeriveDefaults(robot);
  CutBelowFeet(robot);
  return robot;
}

}  // namespace scoria::core
