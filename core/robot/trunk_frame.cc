// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/trunk_frame.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "core/math/so3.h"

namespace scoria::core {
namespace {

const Vec3& Hip(const RobotDescription& robot, Leg leg) { return robot.legs[leg].joints[0].p_PJ; }

/// Foot in the trunk at the URDF's zero.
Vec3 FootAtZero(const LegDescription& leg) {
  Vec3 p = leg.p_LF;
  for (std::size_t j = 3; j-- > 0;) p = leg.joints[j].p_PJ + leg.joints[j].R_PJ * p;
  return p;
}

/// The nearest right-handed set of the frame's own axes, where each is near; else R itself. Hips
/// are not always level with each other.
Mat3 Snapped(const Mat3& R) {
  constexpr double kNear = 0.9;  // cosine
  Mat3 snapped = Mat3::Zero();
  for (int column = 0; column < 3; ++column) {
    Eigen::Index row = 0;
    if (R.col(column).cwiseAbs().maxCoeff(&row) < kNear) return R;
    snapped(row, column) = std::copysign(1.0, R(row, column));
  }
  return snapped.determinant() > 0.5 ? snapped : R;
}

/// Axes of the trunk by its hips, in the URDF's; the URDF's own where hips and names disagree.
Mat3 AxesByHips(const RobotDescription& robot) {
  const Vec3 &fl = Hip(robot, Leg::kFL), &fr = Hip(robot, Leg::kFR), &hl = Hip(robot, Leg::kHL),
             &hr = Hip(robot, Leg::kHR);
  const Vec3 forward = fl + fr - hl - hr, left = fl + hl - fr - hr, up = forward.cross(left);
  constexpr double kDegenerate = 1e-3;  // sine
  if (up.norm() <= kDegenerate * forward.norm() * left.norm() || up.isZero())
    return Mat3::Identity();
  Mat3 R;
  R.col(0) = forward.normalized();
  R.col(2) = up.normalized();
  R.col(1) = R.col(2).cross(R.col(0));
  double hanging = 0.0;
  for (const Leg leg : kLegs)
    hanging += R.col(2).dot(Hip(robot, leg) - FootAtZero(robot.legs[leg]));
  return hanging > 0.0 ? Snapped(R) : Mat3::Identity();
}

bool IsAround(const RobotDescription& robot, const Mat3& R_BN, const Vec3& p_BN) {
  return std::ranges::all_of(
      kLegs, [&](Leg leg) { return IsPlaced(R_BN.transpose() * (Hip(robot, leg) - p_BN), leg); });
}

/// From the frame B to the frame N at p_BN, turned by R_BN.
void Move(RobotDescription& robot, const Mat3& R_BN, const Vec3& p_BN) {
  const Mat3 R_NB = R_BN.transpose();
  const auto moved = [&](const Vec3& p_B) -> Vec3 { return R_NB * (p_B - p_BN); };
  static_cast<SpatialInertia&>(robot.trunk) = {robot.trunk.mass_kg, moved(robot.trunk.p_OC),
                                               R_NB * robot.trunk.I_C * R_BN};
  for (LegDescription& leg : robot.legs) {
    leg.joints[0].p_PJ = moved(leg.joints[0].p_PJ);
    leg.joints[0].R_PJ = R_NB * leg.joints[0].R_PJ;
  }
  robot.p_BS = moved(robot.p_BS);
  robot.R_BS = R_NB * robot.R_BS;
  for (std::vector<Shape>* shapes : {&robot.collisions, &robot.visuals}) {
    for (Shape& shape : *shapes) {
      if (shape.body != 0) continue;
      shape.p_LG = moved(shape.p_LG);
      shape.R_LG = R_NB * shape.R_LG;
    }
  }
}

/// To three decimals, without the sign of a zero.
std::string Shown(const Vec3& v) {
  const Vec3 rounded = (1e3 * v).array().round().matrix() / 1e3;
  return fmt::format("{:g} {:g} {:g}", rounded.x() + 0.0, rounded.y() + 0.0, rounded.z() + 0.0);
}

}  // namespace

bool IsPlaced(const Vec3& p_BHip, Leg leg) {
  return (p_BHip.x() > 0.0) == IsFront(leg) && (p_BHip.y() > 0.0) == IsLeft(leg);
}

Vec3 MiddleOfHips(const RobotDescription& robot) {
  Vec3 sum = Vec3::Zero();
  for (const Leg leg : kLegs) sum += Hip(robot, leg);
  return 0.25 * sum;
}

void PlaceTrunkFrame(RobotDescription& robot) {
  constexpr double kFarthest = 0.2;  // of the leg length; trunks' origins lie at or near the hips
  const LegDescription& leg = robot.legs[Leg::kFL];
  const double length_m = leg.joints[2].p_PJ.norm() + leg.p_LF.norm();
  const Mat3 R_BN = AxesByHips(robot);
  const Vec3 middle = MiddleOfHips(robot);
  if (!IsAround(robot, R_BN, middle)) return;
  const bool is_far = middle.norm() > kFarthest * length_m || !IsAround(robot, R_BN, Vec3::Zero());
  const Vec3 p_BN = is_far ? middle : Vec3::Zero();
  if (!is_far && R_BN.isIdentity()) return;
  robot.remarks.push_back(fmt::format(
      "{}: the trunk's frame is put at ({}) m of it, turned by roll, pitch and yaw of ({}) rad: "
      "amidst the hips, x forwards, z up",
      robot.trunk.name, Shown(p_BN), Shown(RpyFromRotation(R_BN))));
  Move(robot, R_BN, p_BN);
}

}  // namespace scoria::core
