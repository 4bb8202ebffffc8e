// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/bullet_engine.h"

#include <algorithm>
#include <limits>
#include <vector>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "core/demand.h"
#include "sim/engines/bullet/joint_rows.h"
#include "sim/engines/bullet/robot_multibody.h"

namespace scoria::sim {
namespace {

btVector3 ToBullet(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
Vec3 ToVec3(const btVector3& v) { return {v.x(), v.y(), v.z()}; }

/// The robot with a given trunk, and what its joints add.
struct Robot {
  Robot(const core::RobotDescription& robot, const core::SpatialInertia& trunk)
      : multibody(robot, trunk), joints(robot, multibody.body()) {}
  RobotMultiBody multibody;
  JointRows joints;
};

/// Bullet's solver, started from guesses of the impulses: from zero it does not come to rest within
/// its iterations where the friction of the joints holds a standing robot.
class WarmSolver final : public btMultiBodyConstraintSolver {
 public:
  /// @param contacts  with a guess each, one to a manifold; borrowed for the next solution.
  void SetGuesses(std::span<const ContactPoint> contacts) { contacts_ = contacts; }

 protected:
  void convertContacts(btPersistentManifold** manifolds, int count,
                       const btContactSolverInfo& info) override {
    btMultiBodyConstraintSolver::convertContacts(manifolds, count, info);
    for (int i = 0; i < count; ++i) {
      const Vec3& guess_W = contacts_[static_cast<std::size_t>(i)].impulse_W;
      const btManifoldPoint& point = manifolds[i]->getContactPoint(0);
      const auto along = [&](const btVector3& d) { return guess_W.dot(ToVec3(d)); };
      Start(m_multiBodyNormalContactConstraints[i], std::max(0.0, along(point.m_normalWorldOnB)));
      Start(m_multiBodyFrictionContactConstraints[2 * i], along(point.m_lateralFrictionDir1));
      Start(m_multiBodyFrictionContactConstraints[2 * i + 1], along(point.m_lateralFrictionDir2));
    }
    for (int i = 0; i < m_multiBodyNonContactConstraints.size(); ++i) {
      btMultiBodySolverConstraint& row = m_multiBodyNonContactConstraints[i];
      Start(row, row.m_orgConstraint->getAppliedImpulse(row.m_orgDofIndex));
    }
  }

 private:
  void Start(btMultiBodySolverConstraint& row, double impulse) {
    if (impulse == 0.0) return;
    row.m_appliedImpulse = impulse;
    btScalar* response = &m_data.m_deltaVelocitiesUnitImpulse[row.m_jacAindex];
    row.m_multiBodyA->applyDeltaVeeMultiDof2(response, impulse);
    applyDeltaVee(response, impulse, row.m_deltaVelAindex, row.m_multiBodyA->getNumDofs() + 6);
  }

  std::span<const ContactPoint> contacts_;
};

btContactSolverInfo MakeSolverInfo(const SolverParams& params) {
  btContactSolverInfo info;
  info.m_numIterations = params.max_iterations;
  info.m_leastSquaresResidualThreshold = params.residual;
  // Without the second direction a standing robot creeps.
  info.m_solverMode = SOLVER_SIMD | SOLVER_USE_2_FRICTION_DIRECTIONS;
  return info;
}

/// Bullet's form of a contact: body 0 is the robot's.
btManifoldPoint MakePoint(const ContactPoint& c, const Vec3& p_WB) {
  SCORIA_DEMAND(c.rest_m == 0.0 && c.shear_stiffness_N_per_m == 0.0,
                "a contact that remembers: slack at {} m, shear stiffness {} N/m", c.rest_m,
                c.shear_stiffness_N_per_m);
  const btVector3 n = ToBullet(c.n_W), p = ToBullet(p_WB + c.p_BP_W);
  btManifoldPoint point(p, p, n, c.gap_m);
  point.m_positionWorldOnA = p;
  point.m_positionWorldOnB = p - n * c.gap_m;
  point.m_combinedFriction = c.friction;
  point.m_contactPointFlags = BT_CONTACT_FLAG_CONTACT_STIFFNESS_DAMPING;
  point.m_combinedContactStiffness1 = c.stiffness_N_per_m;
  // The damper sets in with the ground.
  point.m_combinedContactDamping1 = c.gap_m < 0.0 ? c.damping_Ns_per_m : 0.0;
  return point;
}

Vec3 ImpulseOf(const btManifoldPoint& point) {
  return ToVec3(point.m_appliedImpulse * point.m_normalWorldOnB +
                point.m_appliedImpulseLateral1 * point.m_lateralFrictionDir1 +
                point.m_appliedImpulseLateral2 * point.m_lateralFrictionDir2);
}

}  // namespace

struct BulletEngine::Impl {
  Impl(const core::RobotDescription& description_in, const Vec3& gravity_in_W,
       const SolverParams& params_in)
      : description(description_in), gravity_W(gravity_in_W), params(params_in) {}

  void ApplyForces(const StepInput& in);
  void MoveFreely(double dt_s);
  void PutContacts(const StepInput& in, std::span<const ContactPoint> contacts);
  void Solve(std::span<const ContactPoint> contacts);

  const core::RobotDescription& description;
  Vec3 gravity_W;
  SolverParams params;
  std::unique_ptr<Robot> robot;  // with the trunk of the last step
  btCollisionObject ground;
  WarmSolver solver;
  JointRowImpulses joint_impulses{};  // of the last step
  btContactSolverInfo info = MakeSolverInfo(params);
  std::vector<std::unique_ptr<btPersistentManifold>> manifolds;  // one per contact, and spare ones
  std::vector<btPersistentManifold*> used;
  btAlignedObjectArray<btScalar> scratch_r;
  btAlignedObjectArray<btVector3> scratch_v;
  btAlignedObjectArray<btMatrix3x3> scratch_m;
};

void BulletEngine::Impl::ApplyForces(const StepInput& in) {
  btMultiBody& body = robot->multibody.body();
  const Vec3 f_W = in.wrench_B_W.head<3>(), p_BD_W = in.wb.state.R_WB * in.trunk.p_OC;
  const Vec3 t_D_W = in.wrench_B_W.tail<3>() - p_BD_W.cross(f_W);
  body.addBaseForce(ToBullet(f_W + in.trunk.mass_kg * gravity_W));
  body.addBaseTorque(ToBullet(t_D_W));
  const auto tau_Nm = Flatten(in.tau_Nm);
  for (int link = 0; link < kNumJoints; ++link) {
    body.addLinkForce(link, ToBullet(body.getLinkMass(link) * gravity_W));
    body.addJointTorque(link, tau_Nm[static_cast<std::size_t>(link)]);
  }
}

/// Velocities without contacts and rows of joints.
void BulletEngine::Impl::MoveFreely(double dt_s) {
  btMultiBody& body = robot->multibody.body();
  body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(dt_s, scratch_r, scratch_v, scratch_m,
                                                            false, false, false);
  body.clearForcesAndTorques();
}

void BulletEngine::Impl::PutContacts(const StepInput& in, std::span<const ContactPoint> contacts) {
  used.clear();
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    if (i == manifolds.size())
      manifolds.push_back(std::make_unique<btPersistentManifold>(
          nullptr, nullptr, 0, std::numeric_limits<double>::max(),
          std::numeric_limits<double>::max()));
    btPersistentManifold& manifold = *manifolds[i];
    manifold.setBodies(&robot->multibody.collider(contacts[i].body), &ground);
    manifold.setNumContacts(1);
    manifold.getContactPoint(0) = MakePoint(contacts[i], in.wb.state.p_WB);
    used.push_back(&manifold);
  }
}

void BulletEngine::Impl::Solve(std::span<const ContactPoint> contacts) {
  solver.SetGuesses(contacts);
  btCollisionObject* base = &robot->multibody.collider(0);
  auto& rows = robot->joints.constraints();
  solver.solveMultiBodyGroup(&base, 1, used.data(), static_cast<int>(used.size()), nullptr, 0,
                             rows.data(), static_cast<int>(rows.size()), info, nullptr, nullptr);
  robot->multibody.body().processDeltaVeeMultiDof2();
  joint_impulses = robot->joints.impulses();
}

BulletEngine::BulletEngine(const core::RobotDescription& robot, const Vec3& gravity_W,
                           const SolverParams& params)
    : impl_(std::make_unique<Impl>(robot, gravity_W, params)) {}

BulletEngine::~BulletEngine() = default;

std::unique_ptr<Engine> BulletEngine::Clone() const {
  auto clone = std::make_unique<BulletEngine>(impl_->description, impl_->gravity_W, impl_->params);
  clone->impl_->joint_impulses = impl_->joint_impulses;
  return clone;
}

void BulletEngine::Reset() noexcept { impl_->joint_impulses = {}; }

StepResult BulletEngine::Step(const StepInput& in, std::span<ContactPoint> contacts) {
  Impl& e = *impl_;
  if (!e.robot || !(e.robot->multibody.trunk() == in.trunk))
    e.robot = std::make_unique<Robot>(e.description, in.trunk);
  RobotMultiBody& multibody = e.robot->multibody;
  e.info.m_timeStep = in.dt_s;
  multibody.SetState(in.wb.state);
  e.robot->joints.Prepare(in.wb.state, e.joint_impulses);
  e.ApplyForces(in);
  e.MoveFreely(in.dt_s);
  e.PutContacts(in, contacts);
  e.Solve(contacts);
  multibody.body().stepPositionsMultiDof(in.dt_s);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].impulse_W = ImpulseOf(e.manifolds[i]->getContactPoint(0));
  StepResult result;
  result.state = multibody.state();
  result.joint_impulse = e.robot->joints.Loads(result.state, in.dt_s);
  result.iterations = e.solver.m_analyticsData.m_numIterationsUsed;
  return result;
}

}  // namespace scoria::sim
