// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/inspect.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "core/robot/normalise.h"
#include "core/robot_files/mesh.h"
#include "core/robot_files/shape_size.h"

namespace scoria::core {
namespace {

constexpr double kRelative = 0.02;  // asymmetry that a maker's rounding does not explain
constexpr std::array<const char*, 3> kJointNames = {"HAA", "HFE", "KFE"};
constexpr std::array<const char*, 3> kLimitKeys = {"haa", "hfe", "kfe"};

bool Differ(double a, double b, double floor) {
  return std::abs(a - b) > kRelative * std::max(std::abs(a), std::abs(b)) + floor;
}

/// Principal moments satisfy a + b >= c for any distribution of mass.
void CheckInertia(const Body& body, double size_m, std::vector<std::string>& out) {
  const Vec3 m = Eigen::SelfAdjointEigenSolver<Mat3>(body.I_C).eigenvalues();
  if (m[0] <= 0.0) {
    out.push_back(fmt::format("{}: inertia has a principal moment of {:.3g} kg m^2, not positive",
                              body.name, m[0]));
  } else if (m[0] + m[1] < m[2] * (1.0 - 1e-6)) {
    out.push_back(fmt::format(
        "{}: principal moments {:.3g}, {:.3g}, {:.3g} kg m^2 violate the triangle inequality",
        body.name, m[0], m[1], m[2]));
  }
  if (m[2] <= 0.0) return;
  const double radius_m = std::sqrt(m[2] / body.mass_kg);
  constexpr double kNarrowest = 0.005;  // of the robot's size
  if (radius_m > size_m || radius_m < kNarrowest * size_m) {
    out.push_back(
        fmt::format("{}: radius of gyration {:.2g} m for {:.3g} kg, of a robot of {:.2f} m",
                    body.name, radius_m, body.mass_kg, size_m));
  }
}

/// Masses as of robots that were built: 70 to 350 kg per cubed leg length, and no link of a leg
/// more than a tenth of it.
void CheckMasses(const RobotDescription& robot, std::vector<std::string>& out) {
  constexpr double kLeast_kgpm3 = 5.0, kMost_kgpm3 = 4000.0, kLargestShare = 0.25;
  const double mass_kg = robot.total_mass_kg(), leg_m = LegLength(robot.legs[Leg::kFL]);
  const double density_kgpm3 = mass_kg / (leg_m * leg_m * leg_m);
  if (density_kgpm3 < kLeast_kgpm3 || density_kgpm3 > kMost_kgpm3) {
    out.push_back(
        fmt::format("{:.4g} kg on legs of {:.3g} m: no robot is so {}; are masses in kg, "
                    "lengths in m?",
                    mass_kg, leg_m, density_kgpm3 < kLeast_kgpm3 ? "light" : "heavy"));
  }
  for (int i = 1; i < kNumBodies; ++i) {
    const Body& link = robot.body(i);
    if (link.mass_kg <= kLargestShare * mass_kg) continue;
    out.push_back(fmt::format("{}: {:.3g} of the robot's {:.3g} kg are in one link of a leg",
                              link.name, link.mass_kg, mass_kg));
  }
}

void CheckLimits(const RobotDescription& robot, std::vector<std::string>& out) {
  std::vector<std::string> weak, unlimited;
  for (const LegDescription& leg : robot.legs) {
    for (const JointDescription& joint : leg.joints) {
      if (joint.effort_Nm <= 0.0) weak.push_back(joint.name);
      if (joint.velocity_radps <= 0.0) unlimited.push_back(joint.name);
    }
  }
  if (!weak.empty()) {
    out.push_back(
        fmt::format("{}: no effort limit, so the robot cannot walk; set limits of the "
                    "robot's YAML",
                    fmt::join(weak, ", ")));
  }
  if (!unlimited.empty()) {
    out.push_back(
        fmt::format("{}: no velocity limit, taken as unlimited", fmt::join(unlimited, ", ")));
  }
}

void CheckMirror(const RobotDescription& robot, Leg left, Leg right,
                 std::vector<std::string>& out) {
  const LegDescription &l = robot.legs[left], &r = robot.legs[right];
  constexpr double kFloor_m = 1e-3, kFloor_kg = 1e-3, kFloor_kgm2 = 1e-5, kFloor_rad = 0.02;
  const auto tell = [&](const std::string& what, double a, double b, const char* unit) {
    out.push_back(fmt::format("{} and {} are no mirror images: {} {:.4g} and {:.4g} {}",
                              LegName(left), LegName(right), what, a, b, unit));
  };
  for (std::size_t j = 0; j < 3; ++j) {
    const Body &bl = l.links[j], &br = r.links[j];
    const std::string name = kJointNames[j];
    if (Differ(bl.mass_kg, br.mass_kg, kFloor_kg))
      tell("mass of the " + name + " link", bl.mass_kg, br.mass_kg, "kg");
    for (int i = 0; i < 3; ++i) {
      const double sign = i == 1 ? -1.0 : 1.0;
      if (Differ(bl.p_OC[i], sign * br.p_OC[i], kFloor_m))
        tell(fmt::format("{} of the COM of the {} link", "xyz"[i], name), bl.p_OC[i], br.p_OC[i],
             i == 1 ? "m, which should be opposite" : "m");
      if (Differ(bl.I_C(i, i), br.I_C(i, i), kFloor_kgm2))
        tell(fmt::format("I{0}{0} of the {1} link", "xyz"[i], name), bl.I_C(i, i), br.I_C(i, i),
             "kg m^2");
      if (Differ(l.joints[j].p_PJ[i], sign * r.joints[j].p_PJ[i], kFloor_m))
        tell(fmt::format("{} of the {} joint", "xyz"[i], name), l.joints[j].p_PJ[i],
             r.joints[j].p_PJ[i], i == 1 ? "m, which should be opposite" : "m");
    }
    if (Differ(l.joints[j].effort_Nm, r.joints[j].effort_Nm, 0.0))
      tell("effort of " + name, l.joints[j].effort_Nm, r.joints[j].effort_Nm, "Nm");
    // HAA turns outwards on either side: its limits change places.
    const bool swapped = j == 0;
    const double lower = swapped ? -r.joints[j].upper_rad : r.joints[j].lower_rad;
    const double upper = swapped ? -r.joints[j].lower_rad : r.joints[j].upper_rad;
    if (Differ(l.joints[j].lower_rad, lower, kFloor_rad))
      tell("lower limit of " + name, l.joints[j].lower_rad, lower, "rad");
    if (Differ(l.joints[j].upper_rad, upper, kFloor_rad))
      tell("upper limit of " + name, l.joints[j].upper_rad, upper, "rad");
  }
  if (Differ(ShankLength(l), ShankLength(r), kFloor_m))
    tell("shank", ShankLength(l), ShankLength(r), "m");
  if (Differ(l.foot_radius_m, r.foot_radius_m, 0.0))
    tell("foot radius", l.foot_radius_m, r.foot_radius_m, "m");
}

/// What the robot's YAML says against what its legs can do.
void CheckConfig(const RobotDescription& robot, std::vector<std::string>& out) {
  const RobotConfig& c = robot.config;
  const LegDescription& leg = robot.legs[Leg::kFL];
  const double length_m = ThighLength(leg) + ShankLength(leg);
  if (c.nominal_height_m > length_m)
    out.push_back(fmt::format("nominal_height_m {:.3f} is beyond thigh and shank, {:.3f} m",
                              c.nominal_height_m, length_m));
  if (c.max_leg_length_m > length_m)
    out.push_back(fmt::format("max_leg_length_m {:.3f} is beyond thigh and shank, {:.3f} m",
                              c.max_leg_length_m, length_m));
  if (c.stance_front_m.y() <= 0.0 || c.stance_hind_m.y() <= 0.0)
    out.push_back("stance_front_m and stance_hind_m are of the left legs: y must be positive");
  if (c.stance_hind_m.x() >= c.stance_front_m.x())
    out.push_back("stance_hind_m lies before stance_front_m");
  for (int j = 0; j < kJointsPerLeg; ++j) {
    const JointDescription& joint = leg.joints[static_cast<std::size_t>(j)];
    if (c.lying_pose_rad[j] >= joint.lower_rad && c.lying_pose_rad[j] <= joint.upper_rad) continue;
    out.push_back(fmt::format("lying_pose_rad: {} of {:.2f} is outside [{:.2f}, {:.2f}]",
                              kJointNames[static_cast<std::size_t>(j)], c.lying_pose_rad[j],
                              joint.lower_rad, joint.upper_rad));
  }
}

constexpr double kLargestShape = 4.0, kSmallestMesh = 0.01;  // of the leg length

void CheckVisuals(const RobotDescription& robot, std::vector<std::string>& out) {
  for (const Shape& shape : robot.visuals) {
    if (shape.kind != Shape::Kind::kMesh) continue;
    const auto bounds = CalcMeshBounds(shape.mesh, shape.size_m);
    if (!bounds) {
      out.push_back(
          fmt::format("visual mesh {} cannot be read and is not drawn", shape.mesh.string()));
      continue;
    }
    const double extent_m = (bounds->high - bounds->low).maxCoeff(),
                 leg_m = LegLength(robot.legs[Leg::kFL]);
    if (extent_m <= kLargestShape * leg_m) continue;
    out.push_back(fmt::format("visual mesh {} is {:.4g} m wide, beside legs of {:.2f} m{}",
                              shape.mesh.string(), extent_m, leg_m, kScaleHint));
  }
}

void CheckShapeSizes(const RobotDescription& robot, std::vector<std::string>& out) {
  const double leg_m = LegLength(robot.legs[Leg::kFL]);
  for (const Shape& shape : robot.collisions) {
    const double extent_m = ExtentOf(shape).maxCoeff();
    const bool is_mesh = !shape.mesh.empty();
    if (extent_m <= kLargestShape * leg_m && (!is_mesh || extent_m >= kSmallestMesh * leg_m))
      continue;
    out.push_back(fmt::format("{}: collides as {} of {:.4g} m, beside legs of {:.2f} m{}",
                              shape.link, is_mesh ? shape.mesh.filename().string() : "a shape",
                              extent_m, leg_m, is_mesh ? kScaleHint : ""));
  }
}

/// The drive trains are those of the robot's YAML, which every joint HAA, HFE or KFE shares.
void CheckDynamics(const RobotDescription& robot, std::vector<std::string>& out) {
  Vec3 damping = Vec3::Zero(), friction = Vec3::Zero();
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const JointDescription& joint = robot.legs[leg].joints[static_cast<std::size_t>(j)];
      damping[j] = std::max(damping[j], joint.urdf_damping_Nms_per_rad);
      friction[j] = std::max(friction[j], joint.urdf_friction_Nm);
    }
  }
  const MotorParams& motors = robot.config.motors;
  const bool is_given = !damping.isZero() || !friction.isZero();
  if (!is_given || (damping == motors.damping_Nms_per_rad && friction == motors.friction_Nm))
    return;
  out.push_back(fmt::format(
      "<dynamics> of the URDF is not used, motors of the robot's YAML are; as the URDF has it: "
      "damping_Nms_per_rad: [{}, {}, {}], friction_Nm: [{}, {}, {}]",
      damping[0], damping[1], damping[2], friction[0], friction[1], friction[2]));
}

/// Limits that no drive of such a robot has, as URDFs carry them where the makers had none to give.
void CheckPlaceholders(const RobotDescription& robot, std::vector<std::string>& out) {
  // Drives give 0.2 to 1.5 m g L and turn at 2 to 8 sqrt(g / L).
  constexpr double kMostEffort = 5.0, kMostVelocity = 15.0, kEarth_mps2 = 9.81;
  const double leg_m = LegLength(robot.legs[Leg::kFL]);
  const double effort_Nm = kMostEffort * robot.total_mass_kg() * kEarth_mps2 * leg_m;
  const double velocity_radps = kMostVelocity * std::sqrt(kEarth_mps2 / leg_m);
  for (std::size_t j = 0; j < 3; ++j) {
    const JointDescription& joint = robot.legs[Leg::kFL].joints[j];
    const auto tell = [&](const char* key, double value, double most, const char* unit) {
      if (value <= most) return;
      out.push_back(fmt::format(
          "{}: limit of {:g} {} looks like a placeholder, drives of such a robot stay below {:.3g} "
          "{}; set limits.{}.{} in the robot's YAML",
          joint.name, value, unit, most, unit, kLimitKeys[j], key));
    };
    tell("effort_Nm", joint.effort_Nm, effort_Nm, "Nm");
    tell("velocity_radps", joint.velocity_radps, velocity_radps, "rad/s");
  }
}

void CheckHeldJoints(const RobotDescription& robot, std::vector<std::string>& out) {
  if (robot.held_joints.empty()) return;
  std::vector<std::string> names;
  double mass_kg = 0.0;
  for (const HeldJoint& joint : robot.held_joints) {
    names.push_back(joint.position == 0.0 ? joint.name
                                          : fmt::format("{} ({:g}, its limit nearest to zero)",
                                                        joint.name, joint.position));
    mass_kg += joint.mass_kg;
  }
  out.push_back(
      fmt::format("{}: in no leg, held at zero; the {:.3g} kg beyond are part of the trunk",
                  fmt::join(names, ", "), mass_kg));
}

}  // namespace

std::vector<std::string> FindModelWarnings(const RobotDescription& robot) {
  std::vector<std::string> out = robot.warnings;
  CheckHeldJoints(robot, out);
  CheckPlaceholders(robot, out);
  CheckShapeSizes(robot, out);
  CheckDynamics(robot, out);
  return out;
}

std::vector<std::string> FindSuspicions(const RobotDescription& robot) {
  std::vector<std::string> out = robot.remarks;
  for (int i = 0; i < kNumBodies; ++i) CheckInertia(robot.body(i), RobotSize(robot), out);
  CheckMasses(robot, out);
  CheckLimits(robot, out);
  CheckConfig(robot, out);
  CheckVisuals(robot, out);
  CheckMirror(robot, Leg::kFL, Leg::kFR, out);
  CheckMirror(robot, Leg::kHL, Leg::kHR, out);
  return out;
}

}  // namespace scoria::core
