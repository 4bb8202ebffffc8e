// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/normalise.h"

#include <algorithm>
#include <cmath>

namespace scoria::core {
namespace {

constexpr double kMakersZero_rad = 0.05;

/// Makes `joint` positive about +`axis` of B and moves its zero by `zero_rad` about that axis.
void Redefine(JointDescription& joint, double sign, double zero_rad) {
  if (std::abs(zero_rad) < kMakersZero_rad) zero_rad = 0.0;
  const double urdf_zero_rad = sign * zero_rad;
  joint.R_PJ = joint.R_PJ * Eigen::AngleAxisd(urdf_zero_rad, joint.axis_J).toRotationMatrix();
  joint.axis_J *= sign;
  const double a = sign * (joint.lower_rad - urdf_zero_rad);
  const double b = sign * (joint.upper_rad - urdf_zero_rad);
  joint.lower_rad = std::min(a, b);
  joint.upper_rad = std::max(a, b);
  joint.urdf_sign = sign;
  joint.urdf_zero_rad = urdf_zero_rad;
}

/// @returns +1 or -1 as the joint turns about +e or -e, 0 if about neither.
double SignAbout(const JointDescription& joint, const Mat3& R_BP, const Vec3& e) {
  constexpr double kAligned = 0.9;  // cosine
  const double along = (R_BP * joint.R_PJ * joint.axis_J).dot(e);
  return std::abs(along) < kAligned ? 0.0 : std::copysign(1.0, along);
}

std::string WrongAxis(const JointDescription& joint, const Mat3& R_BP, const char* want) {
  const Vec3 axis = R_BP * joint.R_PJ * joint.axis_J;
  return fmt::format("{} turns about ({:.2f} {:.2f} {:.2f}) of the trunk, not about its {} axis",
                     joint.name, axis.x(), axis.y(), axis.z(), want);
}

/// Rotation about +y that brings `d`, seen along y, to straight down.
double AngleToDown(const Vec3& d) { return std::atan2(d.x(), -d.z()); }

std::string NormaliseLeg(LegDescription& leg) {
  auto& [haa, hfe, kfe] = leg.joints;
  Mat3 R_BP = Mat3::Identity();
  const double haa_sign = SignAbout(haa, R_BP, Vec3::UnitX());
  if (haa_sign == 0.0) return WrongAxis(haa, R_BP, "x");
  // HAA is zero where the axis of HFE is level.
  const Vec3 pitch_axis = haa.R_PJ * hfe.R_PJ * hfe.axis_J;
  const double tilt = std::atan2(pitch_axis.z(), pitch_axis.y());
  Redefine(haa, haa_sign, -std::remainder(tilt, EIGEN_PI));
  R_BP = R_BP * haa.R_PJ;

  const double hfe_sign = SignAbout(hfe, R_BP, Vec3::UnitY());
  if (hfe_sign == 0.0) return WrongAxis(hfe, R_BP, "y");
  Redefine(hfe, hfe_sign, AngleToDown(R_BP * hfe.R_PJ * kfe.p_PJ));
  R_BP = R_BP * hfe.R_PJ;

  const double kfe_sign = SignAbout(kfe, R_BP, Vec3::UnitY());
  if (kfe_sign == 0.0) return WrongAxis(kfe, R_BP, "y");
  Redefine(kfe, kfe_sign, AngleToDown(R_BP * kfe.R_PJ * leg.p_LF));
  return "";
}

}  // namespace

std::string NormaliseJoints(RobotDescription& robot) {
  for (const Leg leg : kLegs) {
    const std::string problem = NormaliseLeg(robot.legs[leg]);
    if (!problem.empty()) return problem;
    const Vec3& hip = robot.legs[leg].joints[0].p_PJ;
    const bool placed = (hip.x() > 0.0) == IsFront(leg) && (hip.y() > 0.0) == IsLeft(leg);
    if (!placed) {
      return fmt::format(
          "{} has its hip at x {:.3f}, y {:.3f} of the trunk, where another leg "
          "should be",
          LegName(leg), hip.x(), hip.y());
    }
  }
  return "";
}

double ThighLength(const LegDescription& leg) {
  return std::hypot(leg.joints[2].p_PJ.x(), leg.joints[2].p_PJ.z());
}

double ShankLength(const LegDescription& leg) { return std::hypot(leg.p_LF.x(), leg.p_LF.z()); }

void DeriveDefaults(RobotDescription& robot) {
  RobotConfig& config = robot.config;
  const LegDescription &front = robot.legs[Leg::kFL], &hind = robot.legs[Leg::kHL];
  const double length_m = ThighLength(front) + ShankLength(front);
  constexpr double kStandingShare = 0.7, kSpare_m = 0.02;
  if (config.nominal_height_m == 0.0) config.nominal_height_m = kStandingShare * length_m;
  if (config.max_leg_length_m == 0.0) config.max_leg_length_m = length_m - kSpare_m;
  const auto below_thigh = [](const LegDescription& leg) {
    const Vec3 p = leg.joints[0].p_PJ + leg.joints[1].p_PJ;
    return Vec3(p.x(), p.y() + leg.joints[2].p_PJ.y() + leg.p_LF.y(), 0.0);
  };
  if (config.stance_front_m.isZero()) config.stance_front_m = below_thigh(front);
  if (config.stance_hind_m.isZero()) config.stance_hind_m = below_thigh(hind);
  if (config.lying_pose_rad.isZero()) {
    constexpr double kClear_rad = 0.05;
    const double knee = front.joints[2].lower_rad + kClear_rad;
    config.lying_pose_rad = {
        0.0, std::clamp(-0.5 * knee, front.joints[1].lower_rad, front.joints[1].upper_rad), knee};
  }
}

}  // namespace scoria::core
