// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/bullet_engine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "core/demand.h"
#include "sim/bullet_vectors.h"
#include "sim/engines/bullet/joint_inertia.h"
#include "sim/engines/bullet/joint_rows.h"
#include "sim/engines/bullet/robot_multibody.h"

namespace scoria::sim {
namespace {

/// The robot with a given trunk, and what its joints add.
struct Robot {
  Robot(const core::RobotDescription& robot, const core::SpatialInertia& trunk)
      : multibody(robot, trunk),
        joint_inertia(robot.config.motors),
        joint_rows(robot, multibody.body()) {}
  RobotMultiBody multibody;
  JointInertia joint_inertia;
  JointRows joint_rows;
};

/// Bullet's solver of a robot with rotors and dampers, started from guesses of the impulses: from
/// zero it does not come to rest within its iterations where the friction of the joints holds a
/// standing robot.
class RobotSolver final : public btMultiBodyConstraintSolver {
 public:
  /// Both are borrowed for the next solution.
  /// @param contacts  with a guess each, one to a manifold.
  void Prepare(const JointInertia& inertia, std::span<const ContactPoint> contacts) {
    inertia_ = &inertia;
    contacts_ = contacts;
  }

 protected:
  void convertContacts(btPersistentManifold** manifolds, int count,
                       const btContactSolverInfo& info) override {
    btMultiBodyConstraintSolver::convertContacts(manifolds, count, info);
    for (int i = 0; i < count; ++i) {
      btMultiBodySolverConstraint& normal = m_multiBodyNormalContactConstraints[i];
      btMultiBodySolverConstraint& tangent1 = m_multiBodyFrictionContactConstraints[2 * i];
      btMultiBodySolverConstraint& tangent2 = m_multiBodyFrictionContactConstraints[2 * i + 1];
      for (auto* row : {&normal, &tangent1, &tangent2}) AddJointInertia(*row);
      ShareDivisor(tangent1, tangent2);
      const Vec3& guess_W = contacts_[static_cast<std::size_t>(i)].impulse_W;
      const btManifoldPoint& point = manifolds[i]->getContactPoint(0);
      const auto along = [&](const btVector3& d) { return guess_W.dot(ToVec3(d)); };
      Start(normal, std::max(0.0, along(point.m_normalWorldOnB)));
      Start(tangent1, along(point.m_lateralFrictionDir1));
      Start(tangent2, along(point.m_lateralFrictionDir2));
    }
    for (int i = 0; i < m_multiBodyNonContactConstraints.size(); ++i) {
      btMultiBodySolverConstraint& row = m_multiBodyNonContactConstraints[i];
      Start(row, row.m_orgConstraint->getAppliedImpulse(row.m_orgDofIndex));
    }
  }

 private:
  /// Bullet made the row for the robot without rotors and dampers.
  void AddJointInertia(btMultiBodySolverConstraint& row) {
    using Map = Eigen::Map<JointInertia::Velocities>;
    const double before = 1.0 / row.m_jacDiagABInv;  // mobility with softness
    const double after =
        before - inertia_->Correct(Map(&m_data.m_jacobians[row.m_jacAindex]),
                                   Map(&m_data.m_deltaVelocitiesUnitImpulse[row.m_jacAindex]));
    SetMobility(row, after);
  }

  /// The larger eigenvalue of their 2 x 2 block divides both tangents of a contact, so that a foot
  /// slides with its friction exactly against its motion; Bullet gives each its own divisor.
  void ShareDivisor(btMultiBodySolverConstraint& a, btMultiBodySolverConstraint& b) {
    double across = 0.0;
    for (int i = 0; i < JointInertia::kCoordinates; ++i) {
      across += m_data.m_jacobians[a.m_jacAindex + i] *
                m_data.m_deltaVelocitiesUnitImpulse[b.m_jacAindex + i];
    }
    const double aa = 1.0 / a.m_jacDiagABInv, bb = 1.0 / b.m_jacDiagABInv;
    const double larger = 0.5 * (aa + bb) + std::hypot(0.5 * (aa - bb), across);
    SetMobility(a, larger);
    SetMobility(b, larger);
  }

  /// By which the solver divides a row's correction.
  static void SetMobility(btMultiBodySolverConstraint& row, double mobility) {
    const double change = 1.0 / (row.m_jacDiagABInv * mobility);
    for (btScalar* divided : {&row.m_jacDiagABInv, &row.m_rhs, &row.m_cfm}) *divided *= change;
  }

  void Start(btMultiBodySolverConstraint& row, double impulse) {
    if (impulse == 0.0) return;
    row.m_appliedImpulse = impulse;
    btScalar* response = &m_data.m_deltaVelocitiesUnitImpulse[row.m_jacAindex];
    row.m_multiBodyA->applyDeltaVeeMultiDof2(response, impulse);
    applyDeltaVee(response, impulse, row.m_deltaVelAindex, row.m_multiBodyA->getNumDofs() + 6);
  }

  const JointInertia* inertia_ = nullptr;
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
  void MoveFreely(const StepInput& in);
  void AddJointInertia(const StepInput& in);
  void PutContacts(const StepInput& in, std::span<const ContactPoint> contacts);
  void Solve(std::span<const ContactPoint> contacts);

  const core::RobotDescription& description;
  Vec3 gravity_W;
  SolverParams params;
  std::unique_ptr<Robot> robot;  // with the trunk of the last step
  btCollisionObject ground;
  RobotSolver solver;
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
void BulletEngine::Impl::MoveFreely(const StepInput& in) {
  btMultiBody& body = robot->multibody.body();
  body.computeAccelerationsArticulatedBodyAlgorithmMultiDof(in.dt_s, scratch_r, scratch_v,
                                                            scratch_m, false, false, false);
  body.clearForcesAndTorques();
  AddJointInertia(in);
}

/// Bullet's articulated bodies have moved without rotors and dampers.
void BulletEngine::Impl::AddJointInertia(const StepInput& in) {
  btMultiBody& body = robot->multibody.body();
  JointInertia& inertia = robot->joint_inertia;
  JointInertia::Responses V;
  Vec12 free_radps;
  for (int link = 0; link < kNumJoints; ++link) {
    const JointInertia::Velocities impulse = JointInertia::Velocities::Unit(6 + link);
    body.calcAccelerationDeltasMultiDof(impulse.data(), V.col(link).data(), scratch_r, scratch_v);
    free_radps[link] = body.getJointVel(link);
  }
  inertia.Prepare(V, in.dt_s);
  const auto before_radps = Flatten(in.wb.state.qd);
  const JointInertia::Velocities change =
      inertia.FreeChange(Eigen::Map<const Vec12>(before_radps.data()), free_radps);
  body.applyDeltaVeeMultiDof(change.data(), 1.0);
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
  solver.Prepare(robot->joint_inertia, contacts);
  btCollisionObject* base = &robot->multibody.collider(0);
  auto& rows = robot->joint_rows.constraints();
  solver.solveMultiBodyGroup(&base, 1, used.data(), static_cast<int>(used.size()), nullptr, 0,
                             rows.data(), static_cast<int>(rows.size()), info, nullptr, nullptr);
  robot->multibody.body().processDeltaVeeMultiDof2();
  joint_impulses = robot->joint_rows.impulses();
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
  e.ApplyForces(in);
  e.MoveFreely(in);
  e.robot->joint_rows.Prepare(in.wb.state, e.robot->joint_inertia, e.joint_impulses);
  e.PutContacts(in, contacts);
  e.Solve(contacts);
  multibody.body().stepPositionsMultiDof(in.dt_s);
  for (std::size_t i = 0; i < contacts.size(); ++i)
    contacts[i].impulse_W = ImpulseOf(e.manifolds[i]->getContactPoint(0));
  StepResult result;
  result.state = multibody.state();
  result.joint_impulse = e.robot->joint_rows.Loads(result.state, in.dt_s);
  result.iterations = e.solver.m_analyticsData.m_numIterationsUsed;
  return result;
}

}  // namespace scoria::sim
