// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/shape_size.h"

#include "core/robot/normalise.h"

namespace scoria::core {

Vec3 ExtentOf(const Shape& shape) {
  switch (shape.kind) {
    case Shape::Kind::kCylinder:
      return {2.0 * shape.size_m[0], 2.0 * shape.size_m[0], shape.size_m[1]};
    case Shape::Kind::kSphere:
      return Vec3::Constant(2.0 * shape.size_m[0]);
    default:
      return shape.size_m;
  }
}

double RobotSize(const RobotDescription& robot) {
  const Vec3 across = robot.legs[Leg::kFL].joints[0].p_PJ - robot.legs[Leg::kHR].joints[0].p_PJ;
  return across.norm() + LegLength(robot.legs[Leg::kFL]);
}

}  // namespace scoria::core
