// SPDX-License-Identifier: BSD-3-Clause
#include "app/placement.h"

#include <algorithm>

#include "controller/stand_up.h"
#include "core/math/so3.h"
#include "core/robot/normalise.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::app {
namespace {

/// Centres of the feet's spheres where they rest on the ground beside a trunk at p_W.
LegArray<Vec3> RestingFeet(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                           const Vec2& p_W, const Mat3& R_WB) {
  LegArray<Vec3> feet = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    const Vec2 at_W = p_W + (R_WB * robot.NeutralFoothold(leg)).head<2>();
    const double lift_m = robot.legs[leg].foot_radius_m / R_WB(2, 2);
    feet[leg] = {at_W.x(), at_W.y(), ground.HeightAt(at_W.x(), at_W.y()) + lift_m};
  }
  return feet;
}

/// Normal of the plane that the feet are nearest to: across their two diagonals.
Vec3 NormalThrough(const LegArray<Vec3>& feet) {
  const Vec3 forward_left = feet[Leg::kFL] - feet[Leg::kHR];
  const Vec3 forward_right = feet[Leg::kFR] - feet[Leg::kHL];
  return forward_right.cross(forward_left).normalized();
}

}  // namespace

RobotState PlaceStanding(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                         const Vec2& p_W, double yaw_rad) {
  RobotState state;
  const Vec3 n_W = NormalThrough(RestingFeet(robot, ground, p_W, core::RotationZ(yaw_rad)));
  state.R_WB = GroundFrame(n_W, yaw_rad);
  const LegArray<Vec3> feet = RestingFeet(robot, ground, p_W, state.R_WB);
  state.p_WB = {p_W.x(), p_W.y(), 0.0};
  for (const Leg leg : kLegs) {
    const Vec3 from_trunk_W = state.R_WB * robot.NeutralFoothold(leg);
    state.p_WB.z() += (feet[leg].z() - from_trunk_W.z()) / kNumLegs;
  }
  state.p_WB.z() += robot.config.nominal_height_m * state.R_WB(2, 2);
  state.q = controller::StandingPose(robot, robot.config.nominal_height_m);
  for (const Leg leg : kLegs) {
    const Vec3 p_BF = state.R_WB.transpose() * (feet[leg] - state.p_WB);
    state.q[leg] = core::SolveLegIk(robot.legs[leg], p_BF, state.q[leg]);
  }
  return state;
}

RobotState PlaceLying(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                      const Vec2& p_W, double yaw_rad) {
  constexpr double kBelly_m = 0.07;  // the trunk rests on the ground before the folded feet do
  RobotState state;
  state.R_WB = core::RotationZ(yaw_rad);
  state.p_WB = {p_W.x(), p_W.y(), ground.HeightAt(p_W.x(), p_W.y()) + kBelly_m};
  for (const Leg leg : kLegs) {
    state.q[leg] = core::LyingPose(robot, leg);
    const Vec3 p_BF_W = state.R_WB * core::CalcLegKinematics(robot.legs[leg], state.q[leg]).p_BF;
    const double ground_z = ground.HeightAt(p_W.x() + p_BF_W.x(), p_W.y() + p_BF_W.y());
    state.p_WB.z() =
        std::max(state.p_WB.z(), ground_z + robot.legs[leg].foot_radius_m - p_BF_W.z());
  }
  return state;
}

}  // namespace scoria::app
