// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.h"

#include <algorithm>
#include <array>
#include <vector>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <Eigen/Cholesky>
#include <btBulletCollisionCommon.h>

#include "core/demand.h"
#include "core/math/so3.h"
#include "core/robot/kinematics.h"
#include "sim/ground_contact.h"

static_assert(sizeof(btScalar) == 8, "scoria needs Bullet in double precision (bullet-float64)");

namespace scoria::sim {
namespace {

using core::BodyIndex;
using core::kNumBodies;
using core::RobotDescription;
using core::Shape;

constexpr int kRobotGroup = 1, kGroundGroup = 2;

btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
btTransform ToBullet(const Mat3& R, const Vec3& p) {
  return btTransform(
      btMatrix3x3(R(0, 0), R(0, 1), R(0, 2), R(1, 0), R(1, 1), R(1, 2), R(2, 0), R(2, 1), R(2, 2)),
      ToBullet(p));
}
Vec3 ToVec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

std::unique_ptr<btCollisionShape> MakeShape(const Shape& shape) {
  const Vec3& s = shape.size_m;
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return std::make_unique<btBoxShape>(ToBullet(0.5 * s));
    case Shape::Kind::kCylinder:  // as a capsule of the same length: no edges to catch on triangles
      return std::make_unique<btCapsuleShapeZ>(s.x(), std::max(0.0, s.y() - 2.0 * s.x()));
    case Shape::Kind::kSphere:
      return std::make_unique<btSphereShape>(s.x());
    case Shape::Kind::kMesh:
      break;
  }
  SCORIA_DEMAND(false, "a mesh does not collide; MakeRobot puts a box in its place");
}

/// A heightfield that reaches as far as its border's height continues, and as deep as feet sink.
class EndlessHeightfield final : public btHeightfieldTerrainShape {
 public:
  using btHeightfieldTerrainShape::btHeightfieldTerrainShape;
  void getAabb(const btTransform& t, btVector3& low, btVector3& high) const override {
    constexpr double kFar_m = 1e4, kDeep_m = 1.0, kOvershoot_m = 0.1;  // of the bicubic surface
    btHeightfieldTerrainShape::getAabb(t, low, high);
    low.setValue(-kFar_m, -kFar_m, low.z() - kDeep_m);
    high.setValue(kFar_m, kFar_m, high.z() + kOvershoot_m);
  }
};

/// The robot's bodies and the ground as Bullet sees them.
class Collisions {
 public:
  Collisions(const RobotDescription& robot, const terrains::Heightfield& ground)
      : ground_contact_(dispatcher_, ground) {
    world_.getDispatchInfo().m_deterministicOverlappingPairs = true;
    world_.setForceUpdateAllAabbs(false);
    AddGround(ground);
    for (int body = 0; body < kNumBodies; ++body) AddBody(robot, body);
  }
  ~Collisions() {
    for (const auto& object : objects_) world_.removeCollisionObject(object.get());
  }

  /// Appends where bodies at `poses` are at or near the ground.
  void Find(const std::array<core::LinkPose, kNumBodies>& poses, const Vec3& p_WB,
            std::vector<ContactPoint>& contacts) {
    for (const auto& object : objects_) {
      if (object->getUserIndex() == kGroundIndex) continue;
      const auto& [R_WL, p_WL] = poses[static_cast<std::size_t>(object->getUserIndex())];
      object->setWorldTransform(ToBullet(R_WL, p_WL));
    }
    world_.performDiscreteCollisionDetection();
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      const btPersistentManifold& manifold = *dispatcher_.getManifoldByIndexInternal(m);
      const bool ground_first = manifold.getBody0()->getUserIndex() == kGroundIndex;
      const auto* body = ground_first ? manifold.getBody1() : manifold.getBody0();
      for (int i = 0; i < manifold.getNumContacts(); ++i) {
        const btManifoldPoint& point = manifold.getContactPoint(i);
        ContactPoint contact;
        contact.body = body->getUserIndex();
        contact.n_W = (ground_first ? -1.0 : 1.0) * ToVec3(point.m_normalWorldOnB);
        contact.p_BP_W =
            ToVec3(ground_first ? point.getPositionWorldOnB() : point.getPositionWorldOnA()) - p_WB;
        contact.gap_m = point.getDistance();
        contact.is_foot = point.m_userPersistentData != nullptr;
        contacts.push_back(contact);
      }
    }
  }

  /// Forgets cached contacts.
  void Forget() {
    for (int m = 0; m < dispatcher_.getNumManifolds(); ++m) {
      dispatcher_.getManifoldByIndexInternal(m)->clearManifold();
    }
  }

 private:
  static constexpr int kGroundIndex = -1;

  void AddGround(const terrains::Heightfield& ground) {
    constexpr double kMargin_m = 0.01;
    constexpr int kUpAxis = 2;
    const double low = ground.min_m() - kMargin_m, high = ground.max_m() + kMargin_m;
    auto shape = std::make_unique<EndlessHeightfield>(
        ground.nodes(), ground.nodes(), ground.heights_m().data(), low, high, kUpAxis, false);
    shape->setLocalScaling(btVector3(ground.resolution_m(), ground.resolution_m(), 1.0));
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(shape.get());
    object->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT);
    object->setUserIndex(kGroundIndex);
    // Bullet centres the shape between the two heights.
    object->setWorldTransform(ToBullet(Mat3::Identity(), {0.0, 0.0, 0.5 * (low + high)}));
    world_.addCollisionObject(object.get(), kGroundGroup, kRobotGroup);
    shapes_.push_back(std::move(shape));
    objects_.push_back(std::move(object));
  }

  void AddBody(const RobotDescription& robot, int body) {
    auto compound = std::make_unique<btCompoundShape>(false);
    for (const Shape& shape : robot.collisions) {
      if (shape.body != body) continue;
      shapes_.push_back(MakeShape(shape));
      if (shape.is_foot) shapes_.back()->setUserPointer(this);
      compound->addChildShape(ToBullet(shape.R_LG, shape.p_LG), shapes_.back().get());
    }
    if (compound->getNumChildShapes() == 0) return;
    auto object = std::make_unique<btCollisionObject>();
    object->setCollisionShape(compound.get());
    object->setActivationState(DISABLE_DEACTIVATION);
    object->setUserIndex(body);
    world_.addCollisionObject(object.get(), kRobotGroup, kGroundGroup);
    shapes_.push_back(std::move(compound));
    objects_.push_back(std::move(object));
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  GroundContact ground_contact_;
  btDbvtBroadphase broadphase_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
};

}  // namespace

struct World::Impl {
  Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
       const PhysicsParams& params_in, const Vec3& gravity_in_W,
       const std::optional<SlidingPayloadParams>& sliding_in);

  void FindContacts();
  void Integrate(const Vec18& v);
  void RecordContacts();
  void UpdateTruth();
  void Impact(const Mat18& H_before);

  const RobotDescription& robot;
  const terrains::Heightfield& ground;
  PhysicsParams params;
  Vec3 gravity_W;
  core::WholeBodyModel model;
  core::WholeBody whole_body;  // at truth.state, without a sliding payload
  std::optional<SlidingPayload> sliding;
  StepSolver solver;
  Collisions collisions;
  // What a foot of the bare robot typically carries: the ground's damping ratio refers to it, and
  // the ground does not change with the payload.
  double load_kg;
  LegArray<FootGround> feet;
  LegArray<Vec3> foot_impulse_W = ZeroPerLeg();  // of the last step: where the solver starts
  std::vector<ContactPoint> contacts;
  std::int64_t unconverged_steps = 0;
  Truth truth;
  Vec3 impact_v_WB = Vec3::Zero();  // change of v_WB since the last step, by payloads
  Vec3 f_trunk_W = Vec3::Zero(), t_trunk_W = Vec3::Zero();
};

World::Impl::Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
                  const PhysicsParams& params_in, const Vec3& gravity_in_W,
                  const std::optional<SlidingPayloadParams>& sliding_in)
    : robot(robot_in),
      ground(ground_in),
      params(params_in),
      gravity_W(gravity_in_W),
      model(robot_in, gravity_in_W),
      solver(robot_in, {params_in.max_solver_iterations, params_in.solver_residual}),
      collisions(robot_in, ground_in),
      load_kg(robot_in.total_mass_kg() / kNumLegs) {
  if (sliding_in) sliding.emplace(*sliding_in, gravity_in_W);
}

void World::Impl::FindContacts() {
  const RobotState& state = truth.state;
  contacts.clear();
  collisions.Find(core::CalcLinkPoses(robot, state.p_WB, state.R_WB, state.q), state.p_WB,
                  contacts);
  LegArray<bool> near(false);
  for (ContactPoint& c : contacts) {
    const Vec3 p_WP = state.p_WB + c.p_BP_W;
    const terrains::GroundSample sample = ground.GroundAt(p_WP.x(), p_WP.y());
    if (!c.is_foot) {
      PrepareBodyContact(sample, load_kg, c);
      continue;
    }
    const Leg leg = core::LegOf(c.body);
    // The sphere's velocity along the normal is the same all over it.
    feet[leg].Prepare(sample, p_WP, -c.n_W.dot(whole_body.v_WF[leg]), params.step_s, c);
    c.impulse_W = foot_impulse_W[leg];
    near[leg] = true;
  }
  for (const Leg leg : kLegs) {
    if (!near[leg]) feet[leg].Lift();
  }
}

void World::Impl::Integrate(const Vec18& v) {
  RobotState& state = truth.state;
  const double dt = params.step_s;
  truth.a_WB = (v.head<3>() - state.v_WB + impact_v_WB) / dt;
  impact_v_WB.setZero();
  state.v_WB = v.head<3>();
  state.w_WB = v.segment<3>(3);
  state.p_WB += dt * state.v_WB;
  state.R_WB = Quat(core::ExpSo3(dt * state.w_WB) * state.R_WB).normalized().toRotationMatrix();
  for (const Leg leg : kLegs) {
    state.qd[leg] = v.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg));
    state.q[leg] += dt * state.qd[leg];
  }
}

/// Forces of the step, and what the feet did to the ground.
void World::Impl::RecordContacts() {
  truth.f_F_W = foot_impulse_W = ZeroPerLeg();
  truth.f_normal_N = truth.penetration_m = LegArray<double>(0.0);
  Vec3 ground_on_trunk_W = Vec3::Zero();
  for (const ContactPoint& c : contacts) {
    const Vec3 f_W = c.impulse_W / params.step_s;
    if (c.body == 0) ground_on_trunk_W += f_W;
    if (!c.is_foot) continue;
    const Leg leg = core::LegOf(c.body);
    foot_impulse_W[leg] = c.impulse_W;
    truth.f_F_W[leg] = f_W;
    truth.f_normal_N[leg] = c.n_W.dot(f_W);
    truth.penetration_m[leg] = -c.gap_m;
    feet[leg].Finish(c, truth.state.p_WB + c.p_BP_W, params.step_s);
  }
  truth.trunk_force_N = ground_on_trunk_W.norm();
}

void World::Impl::UpdateTruth() {
  model.Calc(truth.state, whole_body);
  truth.p_WC = whole_body.p_WC;
  truth.mass_kg = whole_body.mass_kg;
  truth.p_WF = whole_body.p_WF;
  truth.energy.kinetic_J = CalcKineticEnergy(whole_body);
  // Semi-implicit Euler is a leapfrog: its velocity belongs to half a step ago.
  const Vec3 p_WC_then = whole_body.p_WC - 0.5 * params.step_s * whole_body.v_WC;
  truth.energy.potential_J = -whole_body.mass_kg * gravity_W.dot(p_WC_then);
  truth.trunk = model.parameters().trunk;
  if (!sliding) return;
  const double m = sliding->mass_kg();
  truth.mass_kg += m;
  truth.p_WC += m / truth.mass_kg * (sliding->CalcPosition(truth.state) - truth.p_WC);
  truth.slide_m = sliding->x_m();
  truth.slide_mps = sliding->rate_mps();
  truth.energy.kinetic_J += sliding->CalcKineticEnergy(truth.state);
  truth.energy.potential_J += sliding->CalcPotentialEnergy(truth.state, params.step_s);
}

/// Plastic impact with what was added to the trunk at rest, at a mass matrix that is the new one
/// already. The trunk drags a sliding payload only across its line.
void World::Impl::Impact(const Mat18& H_before) {
  RobotState& state = truth.state;
  Vec18 v;
  v.head<6>() << state.v_WB, state.w_WB;
  for (const Leg leg : kLegs) {
    v.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg)) = state.qd[leg];
  }
  Mat18 H = AssembleMassMatrix(whole_body);
  const Vec18 lacking = (H_before - H) * v;
  if (sliding) H.topLeftCorner<6, 6>() += sliding->CalcImpactInertia(state);
  const Vec18 change = H.llt().solve(lacking);
  if (sliding) sliding->Kick(state, change.head<6>());
  impact_v_WB += change.head<3>();
  state.v_WB += change.head<3>();
  state.w_WB += change.segment<3>(3);
  for (const Leg leg : kLegs) {
    state.qd[leg] += change.segment<3>(6 + kJointsPerLeg * static_cast<int>(leg));
  }
}

World::World(const RobotDescription& robot, const terrains::Heightfield& ground,
             const PhysicsParams& params, const Vec3& gravity_W,
             const std::optional<SlidingPayloadParams>& sliding)
    : impl_(std::make_unique<Impl>(robot, ground, params, gravity_W, sliding)) {
  Reset(RobotState{});
}

World::~World() = default;

void World::Reset(const RobotState& state) {
  Impl& w = *impl_;
  w.collisions.Forget();
  w.foot_impulse_W = ZeroPerLeg();
  w.solver.Reset();
  w.impact_v_WB.setZero();
  if (w.sliding) w.sliding->Reset();
  for (const Leg leg : kLegs) {
    w.feet[leg] = FootGround(w.params.ground, w.robot.legs[leg].foot_radius_m, w.load_kg);
  }
  w.truth = Truth{};
  w.truth.state = state;
  w.UpdateTruth();
  w.truth.energy.initial_J = w.truth.energy.kinetic_J + w.truth.energy.potential_J;
}

void World::Step(const LegArray<Vec3>& tau_Nm) {
  Impl& w = *impl_;
  w.FindContacts();
  const Vec3 p_BC_W = w.truth.state.R_WB * w.robot.trunk.p_OC;
  Vec6 wrench_B_W;
  wrench_B_W << w.f_trunk_W, w.t_trunk_W + p_BC_W.cross(w.f_trunk_W);
  const double dt = w.params.step_s;
  if (w.sliding) w.sliding->AddTo(w.whole_body, dt);
  const Vec18 v = w.solver.Solve(w.whole_body, tau_Nm, wrench_B_W, dt, w.contacts);
  w.RecordContacts();
  if (w.sliding) {
    Vec6 change = v.head<6>();
    change.head<3>() -= w.truth.state.v_WB;
    change.tail<3>() -= w.truth.state.w_WB;
    w.truth.energy.work.joint_J += w.sliding->Step(w.truth.state, change, dt);
  }
  w.Integrate(v);
  w.UpdateTruth();
  w.truth.energy.work += w.solver.work();
  if (w.solver.iterations() >= w.params.max_solver_iterations) ++w.unconverged_steps;
}

const Truth& World::truth() const noexcept { return impl_->truth; }

int World::solver_iterations() const noexcept { return impl_->solver.iterations(); }

std::int64_t World::unconverged_steps() const noexcept { return impl_->unconverged_steps; }

void World::SetTrunkWrench(const Vec3& f_W, const Vec3& t_W) {
  impl_->f_trunk_W = f_W;
  impl_->t_trunk_W = t_W;
}

void World::SetTrunkParameters(const core::SpatialInertia& trunk, AttachVelocity attach_velocity) {
  Impl& w = *impl_;
  EnergyLedger& e = w.truth.energy;
  const double before_J = e.kinetic_J + e.potential_J;
  const Mat18 H_before = AssembleMassMatrix(w.whole_body);
  w.model.SetParameters({trunk});
  if (attach_velocity == AttachVelocity::kRest) {
    w.model.Calc(w.truth.state, w.whole_body);
    w.Impact(H_before);
  }
  w.UpdateTruth();
  e.work.external_J += e.kinetic_J + e.potential_J - before_J;
}

}  // namespace scoria::sim
