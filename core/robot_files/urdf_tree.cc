// SPDX-License-Identifier: BSD-3-Clause
#include "core/robot_files/urdf_tree.h"

#include <algorithm>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <urdf_model/model.h>

#include "core/config/node.h"
#include "core/robot_files/mesh.h"
#include "core/text.h"

namespace scoria::core {
namespace {

[[noreturn]] void Fail(const RobotConfig& config, const std::string& key, const std::string& rule) {
  throw ConfigError({config.urdf.string(), 0, 0}, key, rule);
}

Vec3 ToVec3(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Mat3 ToMat3(const urdf::Rotation& r) {
  double x, y, z, w;
  r.getQuaternion(x, y, z, w);
  return Quat(w, x, y, z).normalized().toRotationMatrix();
}

struct Pose {
  Mat3 R = Mat3::Identity();
  Vec3 p = Vec3::Zero();
  [[nodiscard]] Pose operator*(const urdf::Pose& X) const {
    return {R * ToMat3(X.rotation), p + R * ToVec3(X.position)};
  }
};

/// Walks the URDF tree, merging fixed links into the thirteen bodies.
class TreeWalker {
 public:
  TreeWalker(const RobotConfig& config, const urdf::ModelInterface& model, RobotDescription& robot)
      : config_(config), model_(model), robot_(robot) {
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
    Visit(*TrunkRoot(), 0, Pose{});
    if (!config_.imu_link.empty() && !imu_on_trunk_) {
      Fail(config_, "imu_link", fmt::format("the trunk has no link \"{}\"", config_.imu_link));
    }
    for (const Leg leg : kLegs) {
      if (robot_.legs[leg].foot_radius_m <= 0.0) {
        Fail(config_, "legs",
             fmt::format("foot link \"{}\" is missing or has no collision sphere (and the robot's "
                         "YAML no foot_radius_m)",
                         config_.legs.ToLegArray()[leg].foot));
      }
    }
  }

 private:
  Body& BodyAt(int index) { return const_cast<Body&>(robot_.body(index)); }

  /// The link below the joints that only place the robot in the world (floating, planar, a chain of
  /// them), whose links carry nothing.
  [[nodiscard]] urdf::LinkConstSharedPtr TrunkRoot() const {
    urdf::LinkConstSharedPtr root = model_.getRoot(), at = root;
    while ((!at->inertial || at->inertial->mass == 0.0) && at->collision_array.empty() &&
           at->visual_array.empty() && at->child_joints.size() == 1 &&
           !joint_index_.contains(at->child_joints[0]->name)) {
      const urdf::Joint& joint = *at->child_joints[0];
      at = model_.getLink(joint.child_link_name);
      if (joint.type != urdf::Joint::FIXED) root = at;
    }
    return root;
  }

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
        Fail(config_, of_leg + "foot",
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
      Fail(config_, key,
           fmt::format("the URDF has no joint \"{}\"{}", name, DidYouMean(name, joints)));
    }
    if (joint->type != urdf::Joint::REVOLUTE)
      Fail(config_, key, fmt::format("\"{}\" must be a revolute joint with limits", name));
  }

  void CheckOnce(const std::string& key, const std::string& name,
                 std::map<std::string, std::string>& keys) const {
    const auto [at, is_new] = keys.try_emplace(name, key);
    if (!is_new) Fail(config_, key, fmt::format("\"{}\" is {} already", name, at->second));
  }

  void Visit(const urdf::Link& link, int body, const Pose& X_L) {
    if (X_L.p.isZero() && X_L.R.isIdentity() && BodyAt(body).name.empty()) {
      BodyAt(body).name = link.name;
    }
    if (link.inertial) AddInertia(link, body, X_L);
    if (link.name == config_.imu_link && body == 0) {
      imu_on_trunk_ = true;
      robot_.p_BS = X_L.p;
      robot_.R_BS = X_L.R;
    }
    AddShapes(link, body, X_L);
    for (const auto& joint : link.child_joints) VisitJoint(*joint, body, X_L);
  }

  void VisitJoint(const urdf::Joint& joint, int body, const Pose& X_L) {
    const Pose X_J = X_L * joint.parent_to_joint_origin_transform;
    const auto child = model_.getLink(joint.child_link_name);
    if (joint.type == urdf::Joint::FIXED) {
      Visit(*child, body, X_J);
      return;
    }
    const auto found = joint_index_.find(joint.name);
    if (found == joint_index_.end()) {
      CheckHeld(joint, body);
      robot_.held_joints.push_back(joint.name);
      Visit(*child, body, X_J);
      return;
    }
    const int index = found->second;
    const Leg leg = LegOf(index);
    const auto j = static_cast<std::size_t>(JointOf(index));
    if (body != (j == 0 ? 0 : index - 1)) {
      Fail(config_, joint.name, "does not follow the chain trunk, HAA, HFE, KFE");
    }
    if (!joint.limits) Fail(config_, joint.name, "needs a limit element");
    if (!(joint.limits->lower < joint.limits->upper)) {
      Fail(config_, joint.name,
           fmt::format("lower limit {} must be below upper limit {}", joint.limits->lower,
                       joint.limits->upper));
    }
    robot_.legs[leg].joints[j] = {joint.name,
                                  X_J.p,
                                  X_J.R,
                                  ToVec3(joint.axis).normalized(),
                                  joint.limits->lower,
                                  joint.limits->upper,
                                  joint.limits->effort,
                                  joint.limits->velocity,
                                  1.0,
                                  0.0,
                                  joint.dynamics ? joint.dynamics->damping : 0.0,
                                  joint.dynamics ? joint.dynamics->friction : 0.0};
    Visit(*child, index, Pose{});
  }

  /// A joint that no leg names, as of a spinning lidar, can be held at zero on the trunk.
  void CheckHeld(const urdf::Joint& joint, int body) const {
    if (joint.type == urdf::Joint::FLOATING || joint.type == urdf::Joint::PLANAR) {
      Fail(config_, joint.name,
           "floats below the trunk; only above it, on links that carry nothing, may a joint do so. "
           "Make it fixed");
    }
    if (body != 0) {
      Fail(config_, joint.name,
           fmt::format(
               "moves below {}, but no leg names it; a leg has three joints. Make it fixed",
               robot_.legs[LegOf(body)].joints[static_cast<std::size_t>(JointOf(body))].name));
    }
    if (joint.limits && joint.type != urdf::Joint::CONTINUOUS &&
        !(joint.limits->lower <= 0.0 && joint.limits->upper >= 0.0)) {
      Fail(config_, joint.name,
           fmt::format("is in no leg, so it is held at zero, outside of its limits [{}, {}]. Make "
                       "it fixed at the angle that it should have",
                       joint.limits->lower, joint.limits->upper));
    }
  }

  void AddInertia(const urdf::Link& link, int body, const Pose& X_L) {
    const urdf::Inertial& in = *link.inertial;
    if (in.mass < 0.0) {
      Fail(config_, link.name, fmt::format("mass {} must be >= 0", in.mass));
    }
    Mat3 I;
    I << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    if (in.mass > 0.0 && I.diagonal().minCoeff() < 0.0) {
      Fail(config_, link.name, "inertia must not be negative");
    }
    const Pose X_C = X_L * in.origin;
    MergeInertia(BodyAt(body), {in.mass, X_C.p, X_C.R * I * X_C.R.transpose()});
  }

  void AddShapes(const urdf::Link& link, int body, const Pose& X_L) {
    const auto foot = foot_leg_.find(link.name);
    const bool is_foot = foot != foot_leg_.end();
    if (is_foot) CheckFoot(link, foot->second, body);
    if (is_foot && config_.foot_radius_m > 0.0) {  // stands for whatever the link collides as
      Shape sphere;
      sphere.kind = Shape::Kind::kSphere;
      sphere.body = body;
      sphere.size_m = {config_.foot_radius_m, 0.0, 0.0};
      sphere.p_LG = X_L.p;
      AddCollision(sphere, link.name, &robot_.legs[foot->second]);
    } else {
      for (const auto& collision : link.collision_array) {
        if (!collision->geometry) continue;
        AddCollision(ToShape(*collision->geometry, body, X_L * collision->origin), link.name,
                     is_foot ? &robot_.legs[foot->second] : nullptr);
      }
    }
    for (const auto& visual : link.visual_array) {
      if (!visual->geometry) continue;
      Shape shape = ToShape(*visual->geometry, body, X_L * visual->origin);
      if (visual->material) {
        const urdf::Color& c = visual->material->color;
        shape.colour = {c.r, c.g, c.b};
      }
      if (shape.kind == Shape::Kind::kMesh && !robot_.meshes.contains(shape.mesh_name) &&
          !std::filesystem::exists(shape.mesh)) {
        Remark(fmt::format("{}: visual mesh {} is missing and not drawn", link.name,
                           shape.mesh.string()));
        continue;
      }
      robot_.visuals.push_back(shape);
    }
  }

  void CheckFoot(const urdf::Link& link, Leg leg, int body) const {
    if (body == BodyIndex(leg, Joint::kKFE)) return;
    Fail(config_, link.name, "is named as a foot, but is not fixed to its leg's KFE link");
  }

  /// @param foot_of  the leg whose foot the link is, if any: its first sphere is the foot.
  void AddCollision(Shape shape, const std::string& link, LegDescription* foot_of) {
    shape = Solid(shape, link);
    if (foot_of != nullptr && shape.kind == Shape::Kind::kSphere && foot_of->foot_radius_m == 0.0) {
      shape.is_foot = true;
      foot_of->p_LF = shape.p_LG;
      foot_of->foot_radius_m = shape.size_m.x();
    }
    robot_.collisions.push_back(shape);
  }

  std::optional<MeshBounds> BoundsOf(const Shape& shape) const {
    const auto record = robot_.meshes.find(shape.mesh_name);
    return record == robot_.meshes.end() ? CalcMeshBounds(shape.mesh, shape.size_m)
                                         : Scaled(record->second.bounds, shape.size_m);
  }

  /// A mesh in collision becomes the box around it.
  Shape Solid(const Shape& shape, const std::string& link) {
    if (shape.kind != Shape::Kind::kMesh) return shape;
    const auto bounds = BoundsOf(shape);
    if (!bounds) {
      Fail(config_, link,
           fmt::format("collision mesh {} cannot be read; put it there, or let the link collide as "
                       "a box, cylinder or sphere, or not at all",
                       shape.mesh.string()));
    }
    Remark(fmt::format("{}: collides as the box around {}", link, shape.mesh.filename().string()));
    Shape box = shape;
    box.kind = Shape::Kind::kBox;
    box.size_m = bounds->high - bounds->low;
    box.p_LG = shape.p_LG + shape.R_LG * (0.5 * (bounds->low + bounds->high));
    return box;
  }

  Shape ToShape(const urdf::Geometry& geometry, int body, const Pose& X_G) const {
    Shape shape;
    shape.body = body;
    shape.p_LG = X_G.p;
    shape.R_LG = X_G.R;
    if (geometry.type == urdf::Geometry::BOX) {
      shape.kind = Shape::Kind::kBox;
      shape.size_m = ToVec3(dynamic_cast<const urdf::Box&>(geometry).dim);
    } else if (geometry.type == urdf::Geometry::CYLINDER) {
      const auto& cylinder = dynamic_cast<const urdf::Cylinder&>(geometry);
      shape.kind = Shape::Kind::kCylinder;
      shape.size_m = {cylinder.radius, cylinder.length, 0.0};
    } else if (geometry.type == urdf::Geometry::SPHERE) {
      shape.kind = Shape::Kind::kSphere;
      shape.size_m = {dynamic_cast<const urdf::Sphere&>(geometry).radius, 0.0, 0.0};
    } else {
      const auto& mesh = dynamic_cast<const urdf::Mesh&>(geometry);
      shape.kind = Shape::Kind::kMesh;
      shape.size_m = ToVec3(mesh.scale);
      shape.mesh = FindMesh(mesh.filename, config_.urdf);
      shape.mesh_name = mesh.filename;
    }
    return shape;
  }

  void Remark(const std::string& text) { robot_.remarks.push_back(text); }

  const RobotConfig& config_;
  const urdf::ModelInterface& model_;
  RobotDescription& robot_;
  std::map<std::string, int> joint_index_;
  std::map<std::string, Leg> foot_leg_;
  bool imu_on_trunk_ = false;
};

}  // namespace

void AddUrdfTree(const urdf::ModelInterface& model, RobotDescription& robot) {
  TreeWalker(robot.config, model, robot).Walk();
}

}  // namespace scoria::core
