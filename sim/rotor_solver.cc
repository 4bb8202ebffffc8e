// SPDX-License-Identifier: BSD-3-Clause
#include "sim/rotor_solver.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "core/demand.h"
#include "core/math/cholesky.h"

static_assert(sizeof(btScalar) == 8, "scoria needs Bullet in double precision (bullet-float64)");

namespace scoria::sim {
namespace {

constexpr int kDofs = 18;  // Bullet's order: base angular, base linear, joints
using Mat18x12 = Eigen::Matrix<double, kDofs, 12>;

/// The Woodbury correction at one configuration.
class RotorCorrection {
 public:
  explicit RotorCorrection(const RotorDrives& drives) : drives_(drives) {}

  void Factorize(double dt) {
    Vec18 force = Vec18::Zero();
    for (int j = 0; j < 12; ++j) {
      force[6 + j] = 1.0;
      drives_.body->calcAccelerationDeltasMultiDof(force.data(), response_.col(j).data(),
                                                   scratch_r_, scratch_v_);
      force[6 + j] = 0.0;
    }
    root_ = (drives_.armature_kgm2 + dt * drives_.damping_Nms_per_rad).cwiseSqrt();
    inner_ = root_.asDiagonal() * response_.bottomRows<12>() * root_.asDiagonal();
    inner_.diagonal().array() += 1.0;
    const bool positive = core::FactorCholesky<12>(inner_);
    SCORIA_DEMAND(positive, "mass matrix of the joints is not positive definite");
  }

  /// Velocity change by the impulses that rotors and dampers exert over the step without contacts.
  [[nodiscard]] Vec18 FreeVelocityChange() const {
    const Eigen::Map<const Vec18> velocity(drives_.body->getVelocityVector());
    const Vec12 momentum = drives_.armature_kgm2.cwiseProduct(drives_.qd_before_radps);
    // With an impulse root ∘ μ:  (1 + root G root) μ = (A qd_before) / root − root qd.
    const Vec12 rhs =
        (root_.array() > 0.0)
            .select(momentum.array() / root_.array() - root_.array() * velocity.tail<12>().array(),
                    0.0);
    return response_ * root_.cwiseProduct(SolveInner(rhs));
  }

  /// H⁻¹Jᵀ to (H + A + D dt)⁻¹Jᵀ.
  void Correct(Eigen::Map<Vec18>& response) const {
    const Vec12 inner = SolveInner(root_.cwiseProduct(response.tail<12>()));
    response -= response_ * root_.cwiseProduct(inner);
  }

 private:
  [[nodiscard]] Vec12 SolveInner(Vec12 b) const {
    core::SolveLower<12, 1>(inner_, b);
    core::SolveLowerTransposed<12>(inner_, b);
    return b;
  }

  const RotorDrives& drives_;
  Mat18x12 response_;  // H⁻¹E
  Vec12 root_ = Vec12::Zero();
  Mat12 inner_;  // Cholesky factor
  btAlignedObjectArray<btScalar> scratch_r_;
  btAlignedObjectArray<btVector3> scratch_v_;
};

class RotorSolver final : public btMultiBodyConstraintSolver {
 public:
  explicit RotorSolver(const RotorDrives& drives)
      : drives_(drives), correction_(std::make_unique<RotorCorrection>(drives)) {}

 protected:
  btScalar solveGroupCacheFriendlySetup(btCollisionObject** bodies, int num_bodies,
                                        btPersistentManifold** manifolds, int num_manifolds,
                                        btTypedConstraint** constraints, int num_constraints,
                                        const btContactSolverInfo& info,
                                        btIDebugDraw* drawer) override {
    correction_->Factorize(info.m_timeStep);
    drives_.body->applyDeltaVeeMultiDof(correction_->FreeVelocityChange().data(), 1.0);
    const btScalar result = btMultiBodyConstraintSolver::solveGroupCacheFriendlySetup(
        bodies, num_bodies, manifolds, num_manifolds, constraints, num_constraints, info, drawer);
    CorrectRows(m_multiBodyNormalContactConstraints);
    CorrectRows(m_multiBodyFrictionContactConstraints);
    CorrectRows(m_multiBodyNonContactConstraints);
    return result;
  }

 private:
  /// Replaces each row's responses and rescales what was derived from them. A row may have the
  /// robot on both sides: Bullet's upper joint limit lives on side B.
  void CorrectRows(btMultiBodyConstraintArray& rows) {
    for (int i = 0; i < rows.size(); ++i) {
      btMultiBodySolverConstraint& row = rows[i];
      double change = 0.0;
      if (row.m_multiBodyA == drives_.body) change += CorrectSide(row.m_jacAindex);
      if (row.m_multiBodyB == drives_.body) change += CorrectSide(row.m_jacBindex);
      if (row.m_jacDiagABInv <= 0.0) continue;
      const double total = 1.0 / row.m_jacDiagABInv;  // response plus regularisation
      const double scale = total / (total + change);
      row.m_jacDiagABInv *= scale;
      row.m_rhs *= scale;
      row.m_rhsPenetration *= scale;
      row.m_cfm *= scale;
    }
  }

  /// @returns the change of J H⁻¹ Jᵀ.
  double CorrectSide(int index) {
    const Eigen::Map<const Vec18> jacobian(&m_data.m_jacobians[index]);
    Eigen::Map<Vec18> response(&m_data.m_deltaVelocitiesUnitImpulse[index]);
    const double before = jacobian.dot(response);
    correction_->Correct(response);
    return jacobian.dot(response) - before;
  }

  const RotorDrives& drives_;
  std::unique_ptr<RotorCorrection>
      correction_;  // on its own: it needs stricter alignment than Bullet's allocator
};

}  // namespace

std::unique_ptr<btMultiBodyConstraintSolver> MakeRotorSolver(const RotorDrives& drives) {
  return std::make_unique<RotorSolver>(drives);
}

}  // namespace scoria::sim
