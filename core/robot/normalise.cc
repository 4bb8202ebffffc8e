// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot/normalise.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/robot/trunk_frame.h"

namespace scoria::core {
namespace {

constexpr double kMakersZero_rad = 0.05;

/// Makes `joint` positive about +`axis` of B and moves its zero by `zero_rad` about that axis, to
/// the turn in which its limits lie around zero.
void Redefine(JointDescription& joint, double sign, double zero_rad) {
  if (std::abs(zero_rad) < kMakersZero_rad) zero_rad = 0.0;
  const double urdf_zero_rad = sign * zero_rad;
  joint.R_PJ = joint.R_PJ * Eigen::AngleAxisd(urdf_zero_rad, joint.axis_J).toRotationMatrix();
  joint.axis_J *= sign;
  const double a = sign * (joint.lower_rad - urdf_zero_rad);
  const double b = sign * (joint.upper_rad - urdf_zero_rad);
  joint.urdf_sign = sign;
  if (joint.is_continuous) {
    joint.urdf_zero_rad = urdf_zero_rad;
    joint.lower_rad = -EIGEN_PI;
    joint.upper_rad = EIGEN_PI;
    return;
  }
  const double turns_rad = 2.0 * EIGEN_PI * std::round(0.5 * (a + b) / (2.0 * EIGEN_PI));
  joint.lower_rad = std::min(a, b) - turns_rad;
  joint.upper_rad = std::max(a, b) - turns_rad;
  joint.urdf_zero_rad = urdf_zero_rad + sign * turns_rad;
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

/// Turns the frames of a leg's links parallel to the trunk's at q = 0, whatever the URDF chose.
void AlignFrames(RobotDescription& robot, Leg which) {
  LegDescription& leg = robot.legs[which];
  for (std::size_t j = 0; j < 3; ++j) {
    JointDescription& joint = leg.joints[j];
    const Mat3 R = joint.R_PJ;
    if (R.isIdentity(0.0)) continue;
    joint.R_PJ.setIdentity();
    joint.axis_J = R * joint.axis_J;
    Body& link = leg.links[j];
    link.p_OC = R * link.p_OC;
    link.I_C = R * link.I_C * R.transpose();
    if (j < 2) {
      leg.joints[j + 1].p_PJ = R * leg.joints[j + 1].p_PJ;
      leg.joints[j + 1].R_PJ = R * leg.joints[j + 1].R_PJ;
    } else {
      leg.p_LF = R * leg.p_LF;
    }
    const int body = BodyIndex(which, static_cast<Joint>(j));
    for (std::vector<Shape>* shapes : {&robot.collisions, &robot.visuals}) {
      for (Shape& shape : *shapes) {
        if (shape.body != body) continue;
        shape.p_LG = R * shape.p_LG;
        shape.R_LG = R * shape.R_LG;
      }
    }
  }
}

std::string TooShort(const LegDescription& leg, Leg which) {
  for (const auto& [name, length_m] :
       {std::pair{"thigh", ThighLength(leg)}, {"shank", ShankLength(leg)}}) {
    if (length_m > leg.foot_radius_m) continue;
    return fmt::format("the {} of {} is {:.4f} m long, less than its foot's radius of {:.4f} m",
                       name, LegName(which), length_m, leg.foot_radius_m);
  }
  return "";
}

/// The four hips stand around the origin of the trunk, each in its quarter.
std::string MisplacedHip(const RobotDescription& robot) {
  for (const Leg leg : kLegs) {
    const Vec3& hip = robot.legs[leg].joints[0].p_PJ;
    if (IsPlaced(hip, leg)) continue;
    return fmt::format(
        "{} has its hip at x {:.3f}, y {:.3f} of the trunk, where another leg should be",
        LegName(leg), hip.x(), hip.y());
  }
  return "";
}

}  // namespace

std::string NormaliseJoints(RobotDescription& robot) {
  for (const Leg leg : kLegs) {
    std::string problem = NormaliseLeg(robot.legs[leg]);
    if (problem.empty()) {
      AlignFrames(robot, leg);
      problem = TooShort(robot.legs[leg], leg);
    }
    if (!problem.empty()) return problem;
  }
  const std::string problem = MisplacedHip(robot);
  return problem.empty() ? SettleKneesAndLimits(robot) : problem;
}

double ThighLength(const LegDescription& leg) {
  return std::hypot(leg.joints[2].p_PJ.x(), leg.joints[2].p_PJ.z());
}

double ShankLength(const LegDescription& leg) { return std::hypot(leg.p_LF.x(), leg.p_LF.z()); }

double LegLength(const LegDescription& leg) { return ThighLength(leg) + ShankLength(leg); }

void DeriveDefaults(RobotDescription& robot) {
  RobotConfig& config = robot.config;
  const LegDescription &front = robot.legs[Leg::kFL], &hind = robot.legs[Leg::kHL];
  const double length_m = LegLength(front);
  constexpr double kStandingShare = 0.7;
  const double spare_m = 0.02 * robot.similarity.length;
  if (config.nominal_height_m == 0.0) config.nominal_height_m = kStandingShare * length_m;
  if (config.max_leg_length_m == 0.0) config.max_leg_length_m = length_m - spare_m;
  const auto below_thigh = [](const LegDescription& leg) {
    const Vec3 p = leg.joints[0].p_PJ + leg.joints[1].p_PJ;
    return Vec3(p.x(), p.y() + leg.joints[2].p_PJ.y() + leg.p_LF.y(), 0.0);
  };
  if (config.stance_front_m.isZero()) config.stance_front_m = below_thigh(front);
  if (config.stance_hind_m.isZero()) config.stance_hind_m = below_thigh(hind);
  if (config.lying_pose_rad.isZero()) {
    constexpr double kClear_rad = 0.05, kFolded_rad = 2.7;
    const JointDescription& knee = front.joints[2];
    const double way = KneeWay(front);
    const double limit = way < 0.0 ? knee.lower_rad : knee.upper_rad;
    const double folded = way * std::min(kFolded_rad, std::abs(limit) - kClear_rad);
    config.lying_pose_rad = {
        0.0, std::clamp(-0.5 * folded, front.joints[1].lower_rad, front.joints[1].upper_rad),
        folded};
  }
}

Vec3 LyingPose(const RobotDescription& robot, Leg leg) {
  const Vec3& pose = robot.config.lying_pose_rad;
  const LegDescription& l = robot.legs[leg];
  // A leg whose knee bends the other way folds the other way.
  const double mirror = KneeWay(l) == std::copysign(1.0, pose.z()) ? 1.0 : -1.0;
  Vec3 out(pose.x(), mirror * pose.y(), mirror * pose.z());
  for (std::size_t j = 0; j < 3; ++j) {
    double& angle = out[static_cast<Eigen::Index>(j)];
    angle = std::clamp(angle, l.joints[j].lower_rad, l.joints[j].upper_rad);
  }
  return out;
}

}  // namespace scoria::core
