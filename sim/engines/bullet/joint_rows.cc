// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/joint_rows.h"

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "sim/plant/joint_limit.h"

namespace scoria::sim {
namespace {

constexpr double kUnlimited_Nms = 1e9;

/// One row: u + softness λ = target, for an impulse λ within bounds.
struct RowLaw {
  double target_radps = 0.0, softness = 0.0;
  double low_Nms = -kUnlimited_Nms, high_Nms = kUnlimited_Nms;
};

}  // namespace

class JointRows::Drive final : public btMultiBodyConstraint {
 public:
  enum Row : int { kRotor, kFriction, kLower, kUpper, kNumRows };
  static_assert(kNumRows == kRowsPerJoint);

  Drive(btMultiBody& body, int link, const core::JointDescription& joint,
        const core::MotorParams& motors, int axis)
      : btMultiBodyConstraint(&body, nullptr, link, -1, kNumRows, false,
                              MAX_MULTIBODY_CONSTRAINT_TYPE),
        joint_(joint),
        armature_kgm2_(motors.armature_kgm2[axis]),
        damping_Nms_per_rad_(motors.damping_Nms_per_rad[axis]),
        friction_Nm_(motors.friction_Nm[axis]) {
    finalizeMultiDof();
  }

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    jacobianA(kRotor)[6 + m_bodyA->getLink(m_linkA).m_dofOffset] = 1.0;
    m_numDofsFinalized = m_jacSizeBoth;
  }
  [[nodiscard]] int getIslandIdA() const override { return 0; }
  [[nodiscard]] int getIslandIdB() const override { return 0; }
  void debugDraw(btIDebugDraw*) override {}

  void Prepare(double q, double qd, const std::array<double, kRowsPerJoint>& guess) {
    q_rad_ = q;
    qd_radps_ = qd;
    guess_ = guess;
  }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    for (int row = 0; row < kNumRows; ++row) internalSetAppliedImpulse(row, 0.0);
    const double dt = info.m_timeStep;
    // Rotor and damper push with λ = I (q̇ − q̇⁺) − dt D q̇⁺.
    const double resistance = armature_kgm2_ + dt * damping_Nms_per_rad_;
    if (resistance > 0.0)
      Add(kRotor, {armature_kgm2_ * qd_radps_ / resistance, 1.0 / resistance}, rows, data, info);
    if (friction_Nm_ > 0.0)
      Add(kFriction, {0.0, 0.0, -dt * friction_Nm_, dt * friction_Nm_}, rows, data, info);
    if (const auto retreat = CalcLeastRetreat(q_rad_ - joint_.lower_rad, qd_radps_, dt))
      Add(kLower, {*retreat, 0.0, 0.0, kUnlimited_Nms}, rows, data, info);
    if (const auto retreat = CalcLeastRetreat(joint_.upper_rad - q_rad_, qd_radps_, dt))
      Add(kUpper, {-*retreat, 0.0, -kUnlimited_Nms, 0.0}, rows, data, info);
    filled_ = false;
  }

  [[nodiscard]] std::array<double, kRowsPerJoint> impulses() const {
    return {m_data[kRotor], m_data[kFriction], m_data[kLower], m_data[kUpper]};
  }
  /// Impulse on the joint of all but the rotor's inertia.
  [[nodiscard]] double CalcLoad(double qd_after_radps, double dt_s) const {
    return m_data[kFriction] + m_data[kLower] + m_data[kUpper] -
           dt_s * damping_Nms_per_rad_ * qd_after_radps;
  }

 private:
  void Add(Row row, const RowLaw& law, btMultiBodyConstraintArray& rows,
           btMultiBodyJacobianData& data, const btContactSolverInfo& info) {
    btMultiBodySolverConstraint& r = rows.expandNonInitializing();
    if (filled_) {
      r = pattern_;
    } else {
      const btVector3 none(0.0, 0.0, 0.0);
      fillMultiBodyConstraint(r, data, jacobianA(kRotor), nullptr, none, none, none, none, 0.0,
                              info, -kUnlimited_Nms, kUnlimited_Nms);
      pattern_ = r;
      filled_ = true;
    }
    internalSetAppliedImpulse(row, guess_[static_cast<std::size_t>(row)]);
    const double mobility = 1.0 / pattern_.m_jacDiagABInv + law.softness;  // rad/s per N m s
    r.m_orgConstraint = this;
    r.m_orgDofIndex = row;
    r.m_jacDiagABInv = 1.0 / mobility;
    r.m_rhs = (law.target_radps - m_bodyA->getJointVel(m_linkA)) / mobility;
    r.m_rhsPenetration = 0.0;
    r.m_cfm = law.softness / mobility;
    r.m_appliedImpulse = 0.0;
    r.m_lowerLimit = law.low_Nms;
    r.m_upperLimit = law.high_Nms;
  }

  const core::JointDescription& joint_;
  double armature_kgm2_, damping_Nms_per_rad_, friction_Nm_;
  double q_rad_ = 0.0, qd_radps_ = 0.0;  // at the start of the step
  btMultiBodySolverConstraint pattern_;  // Jacobian and response of this step
  bool filled_ = false;
  std::array<double, kRowsPerJoint> guess_{};
};

JointRows::JointRows(const core::RobotDescription& robot, btMultiBody& body) {
  for (int link = 0; link < kNumJoints; ++link) {
    const int axis = link % kJointsPerLeg;
    const core::LegDescription& leg = robot.legs[core::LegOf(1 + link)];
    const auto i = static_cast<std::size_t>(link);
    drives_[i] = std::make_unique<Drive>(body, link, leg.joints[static_cast<std::size_t>(axis)],
                                         robot.config.motors, axis);
    constraints_[i] = drives_[i].get();
  }
}

JointRows::~JointRows() = default;

void JointRows::Prepare(const RobotState& state, const JointRowImpulses& guess) {
  const auto q = Flatten(state.q), qd = Flatten(state.qd);
  for (std::size_t i = 0; i < kNumJoints; ++i) drives_[i]->Prepare(q[i], qd[i], guess[i]);
}

JointRowImpulses JointRows::impulses() const {
  JointRowImpulses all;
  for (std::size_t i = 0; i < kNumJoints; ++i) all[i] = drives_[i]->impulses();
  return all;
}

LegArray<Vec3> JointRows::Loads(const RobotState& after, double dt_s) const {
  auto impulses = Flatten(after.qd);
  for (std::size_t i = 0; i < kNumJoints; ++i)
    impulses[i] = drives_[i]->CalcLoad(impulses[i], dt_s);
  return Unflatten(impulses);
}

}  // namespace scoria::sim
