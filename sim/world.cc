// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world.h"

#include <array>
#include <vector>

#include <BulletCollision/CollisionShapes/btHeightfieldTerrainShape.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyDynamicsWorld.h>
#include <BulletDynamics/Featherstone/btMultiBodyJointLimitConstraint.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>
#include <Eigen/Eigenvalues>
#include <btBulletDynamicsCommon.h>

#include "core/robot/kinematics.h"
#include "sim/ground_contact.h"
#include "sim/rotor_solver.h"

namespace scoria::sim {
namespace {

using core::Body;
using core::BodyIndex;
using core::kNumBodies;
using core::RobotDescription;
using core::Shape;

constexpr int kRobotGroup = 1, kGroundGroup = 2;
constexpr double kUnlimitedVelocity = 1e4;  // Bullet clamps every velocity coordinate to this

btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
btQuaternion ToQuaternion(const Mat3& R) {
  const Quat q = Quat(R).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}
Vec3 ToVec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
Mat3 ToMat3(const btMatrix3x3& m) {
  Mat3 R;
  for (int i = 0; i < 3; ++i) R.row(i) = ToVec3(m[i]).transpose();
  return R;
}

/// Bullet wants diagonal inertias, so every body uses its principal frame P, with origin at its
/// COM.
struct PrincipalFrame {
  Mat3 R_LP = Mat3::Identity();
  Vec3 moments = Vec3::Zero();
  explicit PrincipalFrame(const Body& body) {
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(body.I_C_L);
    R_LP = solver.eigenvectors();
    if (R_LP.determinant() < 0.0) R_LP.col(2) = -R_LP.col(2);
    moments = solver.eigenvalues();
  }
};

int ParentIndex(int body) { return (body - 1) % kJointsPerLeg == 0 ? 0 : body - 1; }

}  // namespace

struct World::Impl {
  Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
       const PhysicsParams& params_in, const Vec3& gravity_W);
  ~Impl();

  void BuildRobot();
  void BuildColliders();
  void BuildJointLimits();
  void BuildGround();
  [[nodiscard]] btTransform InPrincipalFrame(const Shape& shape) const;
  std::unique_ptr<btCollisionShape> MakeShape(const Shape& shape) const;

  void SetState(const RobotState& state);
  void ReadState(RobotState& state) const;
  void ReadContacts();
  void UpdateTruth(const Vec3& v_before_W, bool stepped);

  const RobotDescription& robot;
  const terrains::Heightfield& ground;
  PhysicsParams params;
  std::vector<PrincipalFrame> frames;
  RotorDrives drives;

  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  GroundContact ground_contact;
  btDbvtBroadphase broadphase;
  std::unique_ptr<btMultiBodyConstraintSolver> solver;
  std::unique_ptr<btMultiBodyDynamicsWorld> world;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
  std::vector<std::unique_ptr<btMultiBodyLinkCollider>> colliders;
  std::vector<std::unique_ptr<btMultiBodyConstraint>> limits;
  std::unique_ptr<btMultiBody> body;
  std::unique_ptr<btCollisionObject> ground_object;
  Truth truth;
  Vec3 f_trunk_W = Vec3::Zero(), t_trunk_W = Vec3::Zero();
};

World::Impl::Impl(const RobotDescription& robot_in, const terrains::Heightfield& ground_in,
                  const PhysicsParams& params_in, const Vec3& gravity_W)
    : robot(robot_in),
      ground(ground_in),
      params(params_in),
      ground_contact(dispatcher, ground_in),
      solver(MakeRotorSolver(drives)),
      world(std::make_unique<btMultiBodyDynamicsWorld>(&dispatcher, &broadphase, solver.get(),
                                                       &configuration)) {
  world->setGravity(ToBullet(gravity_W));
  world->getDispatchInfo().m_deterministicOverlappingPairs = true;
  btContactSolverInfo& info = world->getSolverInfo();
  info.m_numIterations = params.max_solver_iterations;
  info.m_leastSquaresResidualThreshold = params.solver_residual;
  // Without the second friction direction a standing robot creeps on rough ground.
  info.m_solverMode = SOLVER_SIMD | SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS;
  for (int i = 0; i < kNumBodies; ++i) frames.emplace_back(robot.body(i));
  BuildRobot();
  BuildColliders();
  BuildJointLimits();
  BuildGround();
}

World::Impl::~Impl() {
  for (const auto& limit : limits) world->removeMultiBodyConstraint(limit.get());
  world->removeMultiBody(body.get());
  for (const auto& collider : colliders) world->removeCollisionObject(collider.get());
  world->removeCollisionObject(ground_object.get());
}

void World::Impl::BuildRobot() {
  body = std::make_unique<btMultiBody>(kNumJoints, robot.trunk.mass_kg, ToBullet(frames[0].moments),
                                       false, false);
  for (const Leg leg : kLegs) {
    for (std::size_t j = 0; j < 3; ++j) {
      const core::JointDescription& joint = robot.legs[leg].joints[j];
      const int index = BodyIndex(leg, static_cast<Joint>(j)), parent = ParentIndex(index);
      const Body& link = robot.body(index);
      const PrincipalFrame &P = frames[static_cast<std::size_t>(index)],
                           &Q = frames[static_cast<std::size_t>(parent)];
      const Mat3 R_QP = Q.R_LP.transpose() * joint.R_PJ * P.R_LP;
      body->setupRevolute(index - 1, link.mass_kg, ToBullet(P.moments), parent - 1,
                          ToQuaternion(R_QP.transpose()),
                          ToBullet(P.R_LP.transpose() * joint.axis_J),
                          ToBullet(Q.R_LP.transpose() * (joint.p_PJ - robot.body(parent).p_LC)),
                          ToBullet(P.R_LP.transpose() * link.p_LC), true);
    }
  }
  body->finalizeMultiDof();
  body->setLinearDamping(0.0);
  body->setAngularDamping(0.0);
  body->setCanSleep(false);
  body->setUseGyroTerm(true);
  body->setHasSelfCollision(false);
  body->setMaxCoordinateVelocity(kUnlimitedVelocity);
  world->addMultiBody(body.get());
  drives.body = body.get();
  for (int leg = 0; leg < kNumLegs; ++leg) {
    drives.armature_kgm2.segment<3>(3 * leg) = robot.config.motors.armature_kgm2;
    drives.damping_Nms_per_rad.segment<3>(3 * leg) = robot.config.motors.damping_Nms_per_rad;
  }
}

btTransform World::Impl::InPrincipalFrame(const Shape& shape) const {
  const Mat3 R_PL = frames[static_cast<std::size_t>(shape.body)].R_LP.transpose();
  btTransform transform;
  transform.setOrigin(ToBullet(R_PL * (shape.p_LG - robot.body(shape.body).p_LC)));
  transform.setRotation(ToQuaternion(R_PL * shape.R_LG));
  return transform;
}

std::unique_ptr<btCollisionShape> World::Impl::MakeShape(const Shape& shape) const {
  const Vec3& s = shape.size_m;
  switch (shape.kind) {
    case Shape::Kind::kBox:
      return std::make_unique<btBoxShape>(ToBullet(0.5 * s));
    case Shape::Kind::kCylinder:  // as a capsule of the same length: no edges to catch on triangles
      return std::make_unique<btCapsuleShapeZ>(s.x(), std::max(0.0, s.y() - 2.0 * s.x()));
    case Shape::Kind::kSphere:
      return std::make_unique<btSphereShape>(s.x());
  }
  return nullptr;
}

void World::Impl::BuildColliders() {
  for (int index = 0; index < kNumBodies; ++index) {
    auto compound = std::make_unique<btCompoundShape>(false);
    for (const Shape& shape : robot.collisions) {
      if (shape.body != index) continue;
      shapes.push_back(MakeShape(shape));
      compound->addChildShape(InPrincipalFrame(shape), shapes.back().get());
    }
    if (compound->getNumChildShapes() == 0) continue;
    auto collider = std::make_unique<btMultiBodyLinkCollider>(body.get(), index - 1);
    collider->setCollisionShape(compound.get());
    collider->setFriction(1.0);  // Bullet multiplies: the ground's coefficient decides
    collider->setRestitution(0.0);
    collider->setActivationState(DISABLE_DEACTIVATION);
    world->addCollisionObject(collider.get(), kRobotGroup, kGroundGroup);
    if (index == 0) {
      body->setBaseCollider(collider.get());
    } else {
      body->getLink(index - 1).m_collider = collider.get();
    }
    shapes.push_back(std::move(compound));
    colliders.push_back(std::move(collider));
  }
}

void World::Impl::BuildJointLimits() {
  for (const Leg leg : kLegs) {
    for (std::size_t j = 0; j < 3; ++j) {
      const core::JointDescription& joint = robot.legs[leg].joints[j];
      limits.push_back(std::make_unique<btMultiBodyJointLimitConstraint>(
          body.get(), BodyIndex(leg, static_cast<Joint>(j)) - 1, joint.lower_rad, joint.upper_rad));
      limits.back()->finalizeMultiDof();
      world->addMultiBodyConstraint(limits.back().get());
    }
  }
}

void World::Impl::BuildGround() {
  constexpr double kMargin_m = 0.01;
  constexpr int kUpAxis = 2;
  const double low = ground.min_m() - kMargin_m, high = ground.max_m() + kMargin_m;
  auto shape = std::make_unique<btHeightfieldTerrainShape>(
      ground.nodes(), ground.nodes(), ground.heights_m().data(), low, high, kUpAxis, false);
  shape->setLocalScaling(btVector3(ground.resolution_m(), ground.resolution_m(), 1.0));
  ground_object = std::make_unique<btCollisionObject>();
  ground_object->setCollisionShape(shape.get());
  ground_object->setFriction(ground.friction());
  ground_object->setRestitution(0.0);
  btTransform transform;
  transform.setIdentity();
  transform.setOrigin(btVector3(0.0, 0.0, 0.5 * (low + high)));  // Bullet centres the shape there
  ground_object->setWorldTransform(transform);
  world->addCollisionObject(ground_object.get(), kGroundGroup, kRobotGroup);
  shapes.push_back(std::move(shape));
}

void World::Impl::SetState(const RobotState& state) {
  const Vec3 p_BC_W = state.R_WB * robot.trunk.p_LC;
  body->setBasePos(ToBullet(state.p_WB + p_BC_W));
  body->setWorldToBaseRot(ToQuaternion((state.R_WB * frames[0].R_LP).transpose()));
  body->setBaseVel(ToBullet(state.v_WB + state.w_WB.cross(p_BC_W)));
  body->setBaseOmega(ToBullet(state.w_WB));
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const int link = BodyIndex(leg, static_cast<Joint>(j)) - 1;
      body->setJointPos(link, state.q[leg][j]);
      body->setJointVel(link, state.qd[leg][j]);
    }
  }
  btAlignedObjectArray<btQuaternion> rotations;
  btAlignedObjectArray<btVector3> origins;
  body->forwardKinematics(rotations, origins);
  body->updateCollisionObjectWorldTransforms(rotations, origins);
}

void World::Impl::ReadState(RobotState& state) const {
  const Mat3 R_WP = ToMat3(btMatrix3x3(body->getWorldToBaseRot().inverse()));
  state.R_WB = R_WP * frames[0].R_LP.transpose();
  const Vec3 p_BC_W = state.R_WB * robot.trunk.p_LC;
  state.w_WB = ToVec3(body->getBaseOmega());
  state.p_WB = ToVec3(body->getBasePos()) - p_BC_W;
  state.v_WB = ToVec3(body->getBaseVel()) - state.w_WB.cross(p_BC_W);
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const int link = BodyIndex(leg, static_cast<Joint>(j)) - 1;
      state.q[leg][j] = body->getJointPos(link);
      state.qd[leg][j] = body->getJointVel(link);
    }
  }
}

void World::Impl::ReadContacts() {
  for (const Leg leg : kLegs) {
    truth.f_F_W[leg].setZero();
    truth.f_normal_N[leg] = truth.penetration_m[leg] = 0.0;
  }
  Vec3 f_trunk = Vec3::Zero();
  for (int m = 0; m < dispatcher.getNumManifolds(); ++m) {
    const btPersistentManifold* manifold = dispatcher.getManifoldByIndexInternal(m);
    const auto* first = btMultiBodyLinkCollider::upcast(manifold->getBody0());
    const auto* second = btMultiBodyLinkCollider::upcast(manifold->getBody1());
    const auto* collider = first != nullptr ? first : second;
    if (collider == nullptr) continue;
    const double sign = first != nullptr ? 1.0 : -1.0;
    for (int i = 0; i < manifold->getNumContacts(); ++i) {
      const btManifoldPoint& point = manifold->getContactPoint(i);
      const Vec3 f_W = sign / params.step_s *
                       ToVec3(point.m_appliedImpulse * point.m_normalWorldOnB +
                              point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                              point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
      if (point.m_userPersistentData != nullptr) {
        const Leg leg = kLegs[static_cast<std::size_t>(collider->m_link / kJointsPerLeg)];
        truth.f_F_W[leg] += f_W;
        truth.f_normal_N[leg] += point.m_appliedImpulse / params.step_s;
        truth.penetration_m[leg] = -point.getDistance();
      } else if (collider->m_link < 0) {
        f_trunk += f_W;
      }
    }
  }
  truth.trunk_force_N = f_trunk.norm();
}

void World::Impl::UpdateTruth(const Vec3& v_before_W, bool stepped) {
  ReadState(truth.state);
  truth.a_WB = stepped ? Vec3((truth.state.v_WB - v_before_W) / params.step_s) : Vec3::Zero();
  const auto poses = core::CalcLinkPoses(robot, truth.state.p_WB, truth.state.R_WB, truth.state.q);
  for (const Leg leg : kLegs) {
    const core::LinkPose& shank = poses[static_cast<std::size_t>(BodyIndex(leg, Joint::kKFE))];
    truth.p_WF[leg] = shank.p_WL + shank.R_WL * robot.legs[leg].p_LF;
  }
}

World::World(const RobotDescription& robot, const terrains::Heightfield& ground,
             const PhysicsParams& params, const Vec3& gravity_W)
    : impl_(std::make_unique<Impl>(robot, ground, params, gravity_W)) {}

World::~World() = default;

void World::Reset(const RobotState& state) {
  impl_->SetState(state);
  impl_->body->clearForcesAndTorques();
  impl_->body->clearConstraintForces();
  for (int m = 0; m < impl_->dispatcher.getNumManifolds(); ++m) {
    impl_->dispatcher.getManifoldByIndexInternal(m)->clearManifold();
  }
  impl_->truth = Truth{};
  impl_->UpdateTruth(Vec3::Zero(), false);
}

void World::Step(const LegArray<Vec3>& tau_Nm) {
  const std::array<double, kNumJoints> tau = Flatten(tau_Nm);
  for (int j = 0; j < kNumJoints; ++j) {
    impl_->body->addJointTorque(j, tau[static_cast<std::size_t>(j)]);
    impl_->drives.qd_before_radps[j] = impl_->body->getJointVel(j);
  }
  impl_->body->addBaseForce(ToBullet(impl_->f_trunk_W));
  impl_->body->addBaseTorque(ToBullet(impl_->t_trunk_W));
  const Vec3 v_before_W = impl_->truth.state.v_WB;
  constexpr int kExactlyOneStep = 0;
  impl_->world->stepSimulation(impl_->params.step_s, kExactlyOneStep);
  impl_->ReadContacts();
  impl_->UpdateTruth(v_before_W, true);
}

const Truth& World::truth() const noexcept { return impl_->truth; }

void World::SetTrunkWrench(const Vec3& f_W, const Vec3& t_W) {
  impl_->f_trunk_W = f_W;
  impl_->t_trunk_W = t_W;
}

}  // namespace scoria::sim
