// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/config/field.h"
#include "core/robot/leg_options.h"
#include "core/robot/legs.h"
#include "core/robot/mesh_bounds.h"
#include "core/robot/payload_body.h"

namespace scoria::core {

/// Names that tie a leg of the canonical joint convention to a URDF. Signs and zeros of the joints
/// are found from its geometry.
struct LegNames {
  std::string haa, hfe, kfe;  // joints
  std::string foot;           // link whose collision sphere is the foot
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("haa", haa, {.doc = "joint name, hip abduction"});
    a.Required("hfe", hfe, {.doc = "joint name, hip flexion"});
    a.Required("kfe", kfe, {.doc = "joint name, knee flexion"});
    a.Required("foot", foot, {.doc = "link whose collision sphere is the foot"});
  }
};

struct LegNamesPerLeg {
  LegNames fl, fr, hl, hr;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("FL", fl);
    a.Required("FR", fr);
    a.Required("HL", hl);
    a.Required("HR", hr);
  }
  [[nodiscard]] LegArray<LegNames> ToLegArray() const { return {fl, fr, hl, hr}; }
};

/// Drive train and electrical model of the joints HAA, HFE, KFE. Electrical power of the robot is
/// P = idle + sum_j max(0, tau w + copper_loss tau^2), without regeneration.
struct MotorParams {
  Vec3 armature_kgm2 = Vec3::Constant(0.01);
  Vec3 damping_Nms_per_rad = Vec3::Constant(0.1);
  Vec3 friction_Nm = Vec3::Constant(0.2);
  Vec3 copper_loss_W_per_Nm2 = Vec3::Constant(0.5);
  double idle_W = 50.0;
  double delay_s = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kNone = 0.0;
    a.Field("armature_kgm2", armature_kgm2,
            {.min = kNone,
             .max = 1.0,
             .doc = "rotor inertia seen at the joint",
             .scale = dimension::kInertia});
    a.Field("damping_Nms_per_rad", damping_Nms_per_rad,
            {.min = kNone, .max = 10.0, .scale = dimension::kJointDamping});
    a.Field("friction_Nm", friction_Nm,
            {.min = kNone, .max = 10.0, .doc = "Coulomb friction", .scale = dimension::kTorque});
    a.Field(
        "copper_loss_W_per_Nm2", copper_loss_W_per_Nm2,
        {.min = kNone, .max = 100.0, .scale = dimension::kPower / Pow(dimension::kTorque, 2.0)});
    a.Field(
        "idle_W", idle_W,
        {.min = kNone, .max = 1000.0, .doc = "computer and drives", .scale = dimension::kPower});
    a.Field("delay_s", delay_s,
            {.min = kNone, .max = 0.05, .doc = "from command to drive, whole physics steps"});
  }
};

/// Battery: open-circuit voltage linear in charge, behind an inner resistance.
struct BatteryParams {
  double full_V = 33.6, empty_V = 24.0;
  double capacity_Ah = 8.0;
  double resistance_Ohm = 0.1;
  double start_charge = 1.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("full_V", full_V, {.min = 1.0, .max = 1000.0, .doc = "open circuit, charged"});
    a.Field("empty_V", empty_V, {.min = 0.5, .max = 1000.0, .doc = "open circuit, discharged"});
    a.Field("capacity_Ah", capacity_Ah, {.min = 0.01, .max = 1000.0, .scale = dimension::kTorque});
    a.Field("resistance_Ohm", resistance_Ohm,
            {.min = 0.0, .max = 10.0, .scale = Pow(dimension::kPower, -1.0)});
    a.Field("start_charge", start_charge, {.min = 0.0, .max = 1.0, .doc = "share of the capacity"});
  }
  [[nodiscard]] std::string Problem() const {
    return empty_V <= full_V ? "" : "empty_V must not exceed full_V";
  }
};

/// A robot's YAML file.
struct RobotConfig {
  std::string name;
  std::filesystem::path urdf;
  LegNamesPerLeg legs;
  std::string imu_link;
  // 0 (or a zero vector) in these: MakeRobot derives them from the legs.
  double nominal_height_m = 0.0;
  Vec3 stance_front_m = Vec3::Zero();
  Vec3 stance_hind_m = Vec3::Zero();
  Vec3 lying_pose_rad = Vec3::Zero();
  double max_leg_length_m = 0.0;
  double foot_radius_m = 0.0;
  KneeParams knees;
  LegLimitParams limits;
  bool has_foot_sensors = true;
  std::vector<PayloadParams> equipment;
  MotorParams motors;
  BatteryParams battery;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Required("urdf", urdf, {.doc = "relative to this file"});
    a.Required("legs", legs);
    a.Field("imu_link", imu_link, {.doc = "link at the IMU; empty: the base link"});
    a.Field(
        "nominal_height_m", nominal_height_m,
        {.min = 0.0,
         .max = 2.0,
         .doc = "walking: centre of mass over the plane through the footholds; standing up: base "
                "link over the feet's centres; falls: base link over the ground. 0: 0.7 of "
                "thigh and shank"});
    a.Field("stance_front_m", stance_front_m,
            {.doc = "neutral front left foothold from the base link, x y; mirrored to the right; "
                    "zeros: below the thigh"});
    a.Field("stance_hind_m", stance_hind_m, {.doc = "as stance_front_m, hind"});
    a.Field("lying_pose_rad", lying_pose_rad,
            {.doc = "HAA, HFE, KFE when folded on the ground; zeros: the knee as far as it goes"});
    a.Field(
        "max_leg_length_m", max_leg_length_m,
        {.min = 0.0,
         .max = 2.0,
         .doc = "hip to foot; footholds beyond are clipped; 0: thigh and shank less 0.02 (Go2)"});
    a.Field("foot_radius_m", foot_radius_m,
            {.min = 0.0,
             .max = 0.5,
             .doc = "sphere about the foot link; 0: the link's own collision sphere"});
    a.Field("knees", knees, {.doc = "the way they bend"});
    a.Field("limits", limits,
            {.doc = "of the joints, where the URDF has none (continuous joints: +-pi) or "
                    "placeholders"});
    a.Field("has_foot_sensors", has_foot_sensors);
    a.Field(
        "equipment", equipment,
        {.doc =
             "bodies fixed to the trunk that the URDF lacks; part of the model, unlike payloads"});
    a.Field("motors", motors);
    a.Field("battery", battery);
  }
};

/// A rigid body with all links that are fixed to it merged in; its inertia is in its link frame L.
struct Body : SpatialInertia {
  std::string name;
};

/// Fixes a link with that inertia in L to a body; one without mass changes nothing. As Join, with
/// the terms of the link summed first: logs are verified bit for bit, and every robot's inertia is
/// the sum in this order.
void MergeInertia(Body& body, const SpatialInertia& link);

/// A revolute joint in the canonical joint convention: HAA about +x, HFE and KFE about +y of the
/// trunk when q = 0, where the leg hangs straight down. The URDF's angle is urdf_sign q +
/// urdf_zero_rad.
struct JointDescription {
  std::string name;
  Vec3 p_PJ = Vec3::Zero();  // joint frame in the parent link
  Mat3 R_PJ = Mat3::Identity();
  Vec3 axis_J = Vec3::UnitX();
  double lower_rad = 0.0, upper_rad = 0.0, effort_Nm = 0.0, velocity_radps = 0.0;
  bool is_continuous = false;  // in the URDF; limits are +-pi unless the robot's YAML has some
  double urdf_sign = 1.0, urdf_zero_rad = 0.0;
  double urdf_damping_Nms_per_rad = 0.0, urdf_friction_Nm = 0.0;  // <dynamics>; not used
};

struct LegDescription {
  std::array<JointDescription, 3> joints;
  std::array<Body, 3> links;
  Vec3 p_LF = Vec3::Zero();  // foot sphere centre in the shank
  double foot_radius_m = 0.0;
  double knee_way = -1.0;  // -1 bends backwards, +1 forwards
};

/// A shape for collision or drawing, fixed to a body: 0 the trunk, 1 + 3 leg + joint a link. Meshes
/// are for drawing only, convex hulls for collision only.
struct Shape {
  enum class Kind { kBox, kCylinder, kSphere, kMesh, kHull };
  Kind kind = Kind::kBox;
  int body = 0;
  bool is_foot = false;
  // box: edges; cylinder: radius, length; sphere: radius; mesh: scale; hull: edges of its box
  Vec3 size_m = Vec3::Zero();
  std::vector<Vec3> hull;  // its points, m, about the centre of its box
  std::string link;        // of the URDF
  std::filesystem::path mesh;
  std::string mesh_name;     // as the URDF writes it
  Vec3 p_LG = Vec3::Zero();  // geometry centre in the body's link frame; cylinders along their z
  Mat3 R_LG = Mat3::Identity();
  std::array<float, 3> colour = {0.7f, 0.7f, 0.7f};
};

/// A joint that moves in the URDF, outside of the legs; it is held, and what it bears is part of
/// the trunk.
struct HeldJoint {
  std::string name;
  double mass_kg = 0.0;   // of the links beyond it, up to the next joint
  double position = 0.0;  // rad or m: zero, or the limit nearest to it
};

/// A quadruped in the canonical joint convention: a trunk and four legs of HAA, HFE, KFE. Built
/// once, then constant.
struct RobotDescription {
  RobotConfig config;
  std::string urdf_text;
  Body trunk;
  LegArray<LegDescription> legs;
  Vec3 p_BS = Vec3::Zero();  // IMU in the trunk
  Mat3 R_BS = Mat3::Identity();
  std::vector<Shape> collisions, visuals;
  Similarity similarity;              // without its equipment
  std::vector<std::string> remarks;   // what of the URDF could not be taken as it stands
  std::vector<std::string> warnings;  // likewise, where it changes how the robot walks
  std::vector<HeldJoint> held_joints;
  MeshRecords meshes;  // of a robot from a log: they stand for the files

  [[nodiscard]] double total_mass_kg() const;
  /// Neutral foothold in the trunk frame at z = 0: below the hip, widened by the abduction link.
  [[nodiscard]] Vec3 NeutralFoothold(Leg leg) const;
  /// Effort limits, N m, as LegArray of (HAA, HFE, KFE).
  [[nodiscard]] LegArray<Vec3> EffortLimits() const;
  [[nodiscard]] const Body& body(int index) const;
};

inline constexpr int kNumBodies = 1 + kNumJoints;
[[nodiscard]] constexpr int BodyIndex(Leg leg, Joint joint) noexcept {
  return 1 + kJointsPerLeg * static_cast<int>(leg) + static_cast<int>(joint);
}

/// Of a link; not of the trunk.
[[nodiscard]] constexpr Leg LegOf(int body) noexcept {
  return kLegs[static_cast<std::size_t>((body - 1) / kJointsPerLeg)];
}
[[nodiscard]] constexpr Joint JointOf(int body) noexcept {
  return static_cast<Joint>((body - 1) % kJointsPerLeg);
}

}  // namespace scoria::core
