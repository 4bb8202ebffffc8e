// SPDX-License-Identifier: BSD-3-Clause
#include "app/episode/placement.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "controller/stand_up.h"
#include "core/math/so3.h"
#include "core/robot/kinematics.h"
#include "core/robot/normalise.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::app {
namespace {

/// Where the sphere of a foot touches when it is let down onto the ground.
struct FootContact {
  double centre_z_m = -std::numeric_limits<double>::infinity();
  double slope = 0.0, friction = 0.0;  // tangent of the ground's slope there, Coulomb
};

FootContact LetDown(const terrains::Heightfield& ground, const Vec2& p_WF, double radius_m) {
  constexpr double kRings[] = {0.0, 0.25, 0.5, 0.75, 0.95};  // of the radius
  constexpr int kDirections = 8;
  FootContact contact;
  Vec2 touched_W = p_WF;
  for (const double ring : kRings) {
    for (int k = 0; k < (ring == 0.0 ? 1 : kDirections); ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kDirections;
      const Vec2 at_W = p_WF + ring * radius_m * Vec2(std::cos(angle), std::sin(angle));
      const double z_m =
          ground.HeightAt(at_W.x(), at_W.y()) + radius_m * std::sqrt(1.0 - ring * ring);
      if (z_m <= contact.centre_z_m) continue;
      contact.centre_z_m = z_m;
      touched_W = at_W;
    }
  }
  contact.slope = ground.At(touched_W.x(), touched_W.y()).gradient.norm();
  contact.friction = ground.GroundAt(touched_W.x(), touched_W.y()).friction;
  return contact;
}

/// Centres of the feet's spheres where they rest on the ground below a trunk at p_WB.
LegArray<Vec3> RestingFeet(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                           const Vec2& p_WB, const Mat3& R_WB) {
  LegArray<Vec3> feet = ZeroPerLeg();
  for (const Leg leg : kLegs) {
    const Vec2 at_W = p_WB + (R_WB * robot.NeutralFoothold(leg)).head<2>();
    feet[leg] = {at_W.x(), at_W.y(),
                 LetDown(ground, at_W, robot.legs[leg].foot_radius_m).centre_z_m};
  }
  return feet;
}

/// Normal of the plane that the feet are nearest to: across their two diagonals.
Vec3 NormalThrough(const LegArray<Vec3>& feet) {
  const Vec3 forward_left = feet[Leg::kFL] - feet[Leg::kHR];
  const Vec3 forward_right = feet[Leg::kFR] - feet[Leg::kHL];
  return forward_right.cross(forward_left).normalized();
}

double Clearance(const terrains::Heightfield& ground, const Vec3& p_W) {
  return p_W.z() - ground.HeightAt(p_W.x(), p_W.y());
}

/// Share of the friction that is left where a foot touches, and where it would if it settled by
/// half its radius.
double FrictionMargin(const terrains::Heightfield& ground, const Vec3& p_WF, double radius_m) {
  // Of the friction: the feet also push sideways, and the weight is not shared equally.
  constexpr double kUsable = 0.7;
  double margin = 1.0;
  for (const auto& [x, y] :
       {std::pair{0.0, 0.0}, {0.5, 0.0}, {-0.5, 0.0}, {0.0, 0.5}, {0.0, -0.5}}) {
    const FootContact contact = LetDown(ground, p_WF.head<2>() + radius_m * Vec2(x, y), radius_m);
    margin = std::min(margin, 1.0 - contact.slope / (kUsable * contact.friction));
  }
  return margin;
}

/// Hip, knee and foot of a leg that stands.
using LegPoints = std::array<Vec3, 3>;

/// What is left of a leg's reach, as a share of its length; negative where the foot is not reached.
double ReachMargin(const LegPoints& points_W, double missed_m) {
  constexpr double kMiss_m = 0.003, kStretch = 0.95;
  const auto& [p_WH, p_WK, p_WF] = points_W;
  const double stretch = (p_WF - p_WH).norm() / ((p_WK - p_WH).norm() + (p_WF - p_WK).norm());
  return std::min(1.0 - missed_m / kMiss_m, kStretch - stretch);
}

/// Room below thigh and shank, as a share of what is asked for: at each point a third of its height
/// over the foot, a foot's radius at most.
double LinkMargin(const terrains::Heightfield& ground, const LegPoints& points_W, double radius_m) {
  constexpr int kPoints = 5;
  const double foot_z = points_W[2].z() - radius_m;
  double margin = 1.0;
  for (std::size_t link = 0; link < 2; ++link) {
    for (int k = 1; k < kPoints; ++k) {
      const double share = static_cast<double>(k) / kPoints;
      const Vec3 p_W = (1.0 - share) * points_W[link] + share * points_W[link + 1];
      const double wanted_m = std::min(radius_m, (p_W.z() - foot_z) / 3.0);
      margin = std::min(margin, Clearance(ground, p_W) / wanted_m - 1.0);
    }
  }
  return margin;
}

/// Room between the trunk and the ground below the feet's rectangle, as a share of what is asked
/// for.
double TrunkMargin(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                   const RobotState& s) {
  constexpr double kShare = 0.6;  // of the height: a fall is told below 0.4
  constexpr int kSteps = 4;
  const Vec3 front = robot.NeutralFoothold(Leg::kFL), hind = robot.NeutralFoothold(Leg::kHR);
  double margin = 1.0;
  for (int i = 0; i <= kSteps; ++i) {
    for (int j = 0; j <= kSteps; ++j) {
      const Vec3 p_B(hind.x() + (front.x() - hind.x()) * i / kSteps,
                     hind.y() + (front.y() - hind.y()) * j / kSteps, 0.0);
      const double room_m = Clearance(ground, s.p_WB + s.R_WB * p_B);
      margin = std::min(margin, room_m / (kShare * robot.config.nominal_height_m) - 1.0);
    }
  }
  return margin;
}

}  // namespace

RobotState PlaceStanding(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                         const Place& place) {
  RobotState state;
  const Mat3 R_WH = core::RotationZ(place.yaw_rad);
  const Vec3 n_W = NormalThrough(RestingFeet(robot, ground, place.p_WB, R_WH));
  state.R_WB = GroundFrame(n_W, place.yaw_rad);
  const LegArray<Vec3> feet = RestingFeet(robot, ground, place.p_WB, state.R_WB);
  state.p_WB = {place.p_WB.x(), place.p_WB.y(), 0.0};
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
                      const Place& place) {
  // The trunk rests on the ground before the folded feet do.
  const double belly_m = 0.07 * robot.similarity.length;
  RobotState state;
  const Vec2& p_WB = place.p_WB;
  state.R_WB = core::RotationZ(place.yaw_rad);
  state.p_WB = {p_WB.x(), p_WB.y(), ground.HeightAt(p_WB.x(), p_WB.y()) + belly_m};
  for (const Leg leg : kLegs) {
    state.q[leg] = core::LyingPose(robot, leg);
    const Vec3 p_BF_W = state.R_WB * core::CalcLegKinematics(robot.legs[leg], state.q[leg]).p_BF;
    const double ground_z = ground.HeightAt(p_WB.x() + p_BF_W.x(), p_WB.y() + p_BF_W.y());
    state.p_WB.z() =
        std::max(state.p_WB.z(), ground_z + robot.legs[leg].foot_radius_m - p_BF_W.z());
  }
  return state;
}

double CalcStandingMargin(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                          const RobotState& standing) {
  constexpr double kTilt_rad = 0.35;
  const RobotState& s = standing;
  const auto poses = core::CalcLinkPoses(robot, s.p_WB, s.R_WB, s.q);
  double margin = std::min(TrunkMargin(robot, ground, s),
                           1.0 - std::acos(std::clamp(s.R_WB(2, 2), -1.0, 1.0)) / kTilt_rad);
  const LegArray<Vec3> feet = RestingFeet(robot, ground, s.p_WB.head<2>(), s.R_WB);
  for (const Leg leg : kLegs) {
    const auto joint = [&](Joint j) {
      return poses[static_cast<std::size_t>(core::BodyIndex(leg, j))].p_WL;
    };
    const Vec3 p_BF = core::CalcLegKinematics(robot.legs[leg], s.q[leg]).p_BF;
    const Vec3 p_WF = s.p_WB + s.R_WB * p_BF;
    const LegPoints points_W = {joint(Joint::kHFE), joint(Joint::kKFE), p_WF};
    const double radius_m = robot.legs[leg].foot_radius_m;
    margin = std::min({margin, FrictionMargin(ground, p_WF, radius_m),
                       ReachMargin(points_W, (p_WF - feet[leg]).norm()),
                       LinkMargin(ground, points_W, radius_m)});
  }
  return margin;
}

ChosenPlace ChoosePlace(const core::RobotDescription& robot, const terrains::Heightfield& ground,
                        std::span<const Place> places) {
  ChosenPlace best{places.front(), -std::numeric_limits<double>::infinity()};
  for (const Place& place : places) {
    const double margin = CalcStandingMargin(robot, ground, PlaceStanding(robot, ground, place));
    if (margin > best.margin) best = {place, margin};
    if (margin > 0.0) break;
  }
  return best;
}

}  // namespace scoria::app
