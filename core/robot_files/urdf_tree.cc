// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/urdf_tree.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <urdf_model/model.h>

#include "core/config/node.h"
#include "core/robot_files/urdf_error.h"
#include "core/robot_files/urdf_pose.h"
#include "core/robot_files/urdf_shapes.h"
#include "core/robot_files/urdf_trunk.h"
#include "core/text.h"

namespace scoria::core {
namespace {

/// Walks the URDF tree, merging fixed links into the thirteen bodies.
class TreeWalker {
 public:
  TreeWalker(const RobotConfig& config, const urdf::ModelInterface& model, RobotDescription& robot)
      : config_(config), model_(model), robot_(robot), shapes_(robot) {
    for (const Leg leg : kLegs) {
      const LegNames names = config.legs.ToLegArray()[leg];
      joint_index_[names.haa] = BodyIndex(leg, Joint::kHAA);
      joint_index_[names.hfe] = BodyIndex(leg, Joint::kHFE);
      joint_index_[names.kfe] = BodyIndex(leg, Joint::kKFE);
      foot_leg_[names.foot] = leg;
    }
  }

  void Walk() {
    CheckNames();
    const LegArray<LegNames> legs = config_.legs.ToLegArray();
    const auto trunk = FindTrunk(
        model_, {legs[Leg::kFL].haa, legs[Leg::kFR].haa, legs[Leg::kHL].haa, legs[Leg::kHR].haa});
    Visit(*trunk, 0, UrdfPose{});
    VisitAbove(*trunk, UrdfPose{});
    shapes_.Finish();
    if (!config_.imu_link.empty() && !imu_on_trunk_) {
      FailUrdf(config_, "imu_link", fmt::format("the trunk has no link \"{}\"", config_.imu_link));
    }
    for (const Leg leg : kLegs) {
      if (robot_.legs[leg].foot_radius_m <= 0.0) {
        FailUrdf(
            config_, "legs",
            fmt::format("foot link \"{}\" is missing or has no collision sphere (and the robot's "
                        "YAML no foot_radius_m)",
                        config_.legs.ToLegArray()[leg].foot));
      }
    }
  }

 private:
  Body& BodyAt(int index) { return const_cast<Body&>(robot_.body(index)); }

  /// Every joint and foot that the robot's YAML names is there, once, and of the right kind.
  void CheckNames() const {
    std::vector<std::string> joints, links;
    for (const auto& [name, joint] : model_.joints_) joints.push_back(name);
    for (const auto& [name, link] : model_.links_) links.push_back(name);
    std::map<std::string, std::string> keys;  // name to the key that gave it
    for (const Leg leg : kLegs) {
      const LegNames names = config_.legs.ToLegArray()[leg];
      const std::string of_leg = fmt::format("legs.{}.", LegName(leg));
      for (const auto& [key, name] :
           {std::pair{"haa", names.haa}, {"hfe", names.hfe}, {"kfe", names.kfe}}) {
        CheckJoint(of_leg + key, name, joints);
        CheckOnce(of_leg + key, name, keys);
      }
      if (!model_.getLink(names.foot)) {
        FailUrdf(config_, of_leg + "foot",
                 fmt::format("the URDF has no link \"{}\"{}", names.foot,
                             DidYouMean(names.foot, links)));
      }
      CheckOnce(of_leg + "foot", names.foot, keys);
    }
  }

  void CheckJoint(const std::string& key, const std::string& name,
                  const std::vector<std::string>& joints) const {
    const auto joint = model_.getJoint(name);
    if (!joint) {
      FailUrdf(config_, key,
               fmt::format("the URDF has no joint \"{}\"{}", name, DidYouMean(name, joints)));
    }
    if (joint->type != urdf::Joint::REVOLUTE && joint->type != urdf::Joint::CONTINUOUS)
      FailUrdf(config_, key, fmt::format("\"{}\" must be a revolute or continuous joint", name));
  }

  void CheckOnce(const std::string& key, const std::string& name,
                 std::map<std::string, std::string>& keys) const {
    const auto [at, is_new] = keys.try_emplace(name, key);
    if (!is_new) FailUrdf(config_, key, fmt::format("\"{}\" is {} already", name, at->second));
  }

  void Visit(const urdf::Link& link, int body, const UrdfPose& X_L) {
    Merge(link, body, X_L);
    for (const auto& joint : link.child_joints) VisitJoint(*joint, body, X_L);
  }

  /// Makes a link part of a body.
  void Merge(const urdf::Link& link, int body, const UrdfPose& X_L) {
    if (X_L.p.isZero() && X_L.R.isIdentity() && BodyAt(body).name.empty()) {
      BodyAt(body).name = link.name;
    }
    if (link.inertial) AddInertia(link, body, X_L);
    if (link.name == config_.imu_link && body == 0) {
      imu_on_trunk_ = true;
      robot_.p_BS = X_L.p;
      robot_.R_BS = X_L.R;
    }
    const auto foot = foot_leg_.find(link.name);
    const bool is_foot = foot != foot_leg_.end();
    if (is_foot) CheckFoot(link, foot->second, body);
    shapes_.Add(link, body, X_L, is_foot ? &robot_.legs[foot->second] : nullptr);
  }

  /// What the trunk hangs from: merged into it, but for joints that only place the robot in the
  /// world.
  void VisitAbove(const urdf::Link& link, const UrdfPose& X_L) {
    if (!link.parent_joint) return;
    const urdf::Joint& joint = *link.parent_joint;
    const auto parent = link.getParent();
    if (joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR) return;
    UrdfPose X_J = X_L;  // of the joint's frame before it turns
    if (joint.type != urdf::Joint::FIXED) {
      if (IsBare(*model_.getRoot(), &link)) return;
      X_J = X_L.Above(Held(joint, FixedMass(*parent, &link)));
    }
    const UrdfPose X_P = X_J.Above(joint.parent_to_joint_origin_transform);
    Merge(*parent, 0, X_P);
    for (const auto& other : parent->child_joints) {
      if (other->child_link_name != link.name) VisitJoint(*other, 0, X_P);
    }
    VisitAbove(*parent, X_P);
  }

  void VisitJoint(const urdf::Joint& joint, int body, const UrdfPose& X_L) {
    const UrdfPose X_J = X_L * joint.parent_to_joint_origin_transform;
    const auto child = model_.getLink(joint.child_link_name);
    if (joint.type == urdf::Joint::FIXED) {
      Visit(*child, body, X_J);
      return;
    }
    const auto found = joint_index_.find(joint.name);
    if (found == joint_index_.end()) {
      CheckHeld(joint, body);
      Visit(*child, body, X_J * Held(joint, FixedMass(*child, nullptr)));
      return;
    }
    AddJoint(joint, found->second, body, X_J);
    Visit(*child, found->second, UrdfPose{});
  }

  void AddJoint(const urdf::Joint& joint, int index, int body, const UrdfPose& X_J) {
    const Leg leg = LegOf(index);
    const auto j = static_cast<std::size_t>(JointOf(index));
    if (body != (j == 0 ? 0 : index - 1)) {
      FailUrdf(config_, joint.name, "does not follow the chain trunk, HAA, HFE, KFE");
    }
    const bool is_continuous = joint.type == urdf::Joint::CONTINUOUS;
    JointDescription& out = robot_.legs[leg].joints[j];
    out.name = joint.name;
    out.p_PJ = X_J.p;
    out.R_PJ = X_J.R;
    out.axis_J = ToVec3(joint.axis).normalized();
    out.is_continuous = is_continuous;
    out.lower_rad = is_continuous ? -EIGEN_PI : joint.limits->lower;
    out.upper_rad = is_continuous ? EIGEN_PI : joint.limits->upper;
    out.effort_Nm = joint.limits ? joint.limits->effort : 0.0;
    out.velocity_radps = joint.limits ? joint.limits->velocity : 0.0;
    out.urdf_damping_Nms_per_rad = joint.dynamics ? joint.dynamics->damping : 0.0;
    out.urdf_friction_Nm = joint.dynamics ? joint.dynamics->friction : 0.0;
    if (out.lower_rad < out.upper_rad) return;
    FailUrdf(
        config_, joint.name,
        fmt::format("lower limit {} must be below upper limit {}", out.lower_rad, out.upper_rad));
  }

  /// A joint that no leg names, as of an arm or a spinning lidar, can be held on the trunk.
  void CheckHeld(const urdf::Joint& joint, int body) const {
    if (joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR) {
      FailUrdf(config_, joint.name,
               "floats below the trunk; only above it may a joint do so. Make it fixed");
    }
    if (body != 0) {
      FailUrdf(config_, joint.name,
               fmt::format(
                   "moves below {}, but no leg names it; a leg has three joints. Make it fixed",
                   robot_.legs[LegOf(body)].joints[static_cast<std::size_t>(JointOf(body))].name));
    }
  }

  /// Holds a joint at zero, or at the limit nearest to it, with the mass of the links beyond it.
  /// @returns the child's pose in its frame.
  urdf::Pose Held(const urdf::Joint& joint, double mass_kg) {
    const bool is_limited = joint.limits && joint.type != urdf::Joint::CONTINUOUS &&
                            joint.limits->lower < joint.limits->upper;
    const double at = is_limited ? std::clamp(0.0, joint.limits->lower, joint.limits->upper) : 0.0;
    robot_.held_joints.push_back({joint.name, mass_kg, at});
    urdf::Pose X;
    const Vec3 axis = ToVec3(joint.axis).normalized();
    if (at != 0.0 && joint.type == urdf::Joint::PRISMATIC) {
      X.position = {at * axis.x(), at * axis.y(), at * axis.z()};
    } else if (at != 0.0) {
      const Quat q(Eigen::AngleAxisd(at, axis));
      X.rotation = urdf::Rotation(q.x(), q.y(), q.z(), q.w());
    }
    return X;
  }

  void AddInertia(const urdf::Link& link, int body, const UrdfPose& X_L) {
    const urdf::Inertial& in = *link.inertial;
    if (in.mass < 0.0) {
      FailUrdf(config_, link.name, fmt::format("mass {} must be >= 0", in.mass));
    }
    Mat3 I;
    I << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    if (in.mass > 0.0 && I.diagonal().minCoeff() < 0.0) {
      FailUrdf(config_, link.name, "inertia must not be negative");
    }
    const UrdfPose X_C = X_L * in.origin;
    MergeInertia(BodyAt(body), {in.mass, X_C.p, X_C.R * I * X_C.R.transpose()});
  }

  void CheckFoot(const urdf::Link& link, Leg leg, int body) const {
    if (body == BodyIndex(leg, Joint::kKFE)) return;
    FailUrdf(config_, link.name, "is named as a foot, but is not fixed to its leg's KFE link");
  }

  const RobotConfig& config_;
  const urdf::ModelInterface& model_;
  RobotDescription& robot_;
  UrdfShapes shapes_;
  std::map<std::string, int> joint_index_;
  std::map<std::string, Leg> foot_leg_;
  bool imu_on_trunk_ = false;
};

}  // namespace

void AddUrdfTree(const urdf::ModelInterface& model, RobotDescription& robot) {
  TreeWalker(robot.config, model, robot).Walk();
}

}  // namespace scoria::core
