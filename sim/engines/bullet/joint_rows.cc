// SPDX-License-Identifier: BSD-3-Clause
#include "sim/engines/bullet/joint_rows.h"

#include <optional>

#include <BulletDynamics/Featherstone/btMultiBody.h>
#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "sim/plant/joint_limit.h"

namespace scoria::sim {
namespace {

constexpr double kUnlimited_Nms = 1e9;

/// One row: u ≥, = or ≤ target, for an impulse within bounds.
struct RowLaw {
  double target_radps = 0.0;
  double low_Nms = -kUnlimited_Nms, high_Nms = kUnlimited_Nms;
};

}  // namespace

class JointRows::Drive final : public btMultiBodyConstraint {
 public:
  enum Row : int { kFriction, kLower, kUpper, kNumRows };
  static_assert(kNumRows == kRowsPerJoint);

  Drive(btMultiBody& body, int link, const core::JointDescription& joint,
        const core::MotorParams& motors, int axis)
      : btMultiBodyConstraint(&body, nullptr, link, -1, kNumRows, false,
                              MAX_MULTIBODY_CONSTRAINT_TYPE),
        joint_(joint),
        damping_Nms_per_rad_(motors.damping_Nms_per_rad[axis]),
        friction_Nm_(motors.friction_Nm[axis]) {
    finalizeMultiDof();
  }

  void finalizeMultiDof() override {
    allocateJacobiansMultiDof();
    m_numDofsFinalized = m_jacSizeBoth;
  }
  [[nodiscard]] int getIslandIdA() const override { return 0; }
  [[nodiscard]] int getIslandIdB() const override { return 0; }
  void debugDraw(btIDebugDraw*) override {}

  void Prepare(double q, double qd, const JointInertia::Responses& responses,
               const std::array<double, kRowsPerJoint>& guess) {
    q_rad_ = q;
    qd_radps_ = qd;
    response_ = responses.col(m_linkA);
    guess_ = guess;
  }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& data,
                            const btContactSolverInfo& info) override {
    for (int row = 0; row < kNumRows; ++row) internalSetAppliedImpulse(row, 0.0);
    const double dt = info.m_timeStep;
    pattern_.reset();
    if (friction_Nm_ > 0.0)
      Add(kFriction, {0.0, -dt * friction_Nm_, dt * friction_Nm_}, rows, data);
    if (const auto retreat = CalcLeastRetreat(q_rad_ - joint_.lower_rad, qd_radps_, dt))
      Add(kLower, {*retreat, 0.0, kUnlimited_Nms}, rows, data);
    if (const auto retreat = CalcLeastRetreat(joint_.upper_rad - q_rad_, qd_radps_, dt))
      Add(kUpper, {-*retreat, -kUnlimited_Nms, 0.0}, rows, data);
  }

  [[nodiscard]] std::array<double, kRowsPerJoint> impulses() const {
    return {m_data[kFriction], m_data[kLower], m_data[kUpper]};
  }
  /// Impulse on the joint of damper, friction and limits.
  [[nodiscard]] double CalcLoad(double qd_after_radps, double dt_s) const {
    return m_data[kFriction] + m_data[kLower] + m_data[kUpper] -
           dt_s * damping_Nms_per_rad_ * qd_after_radps;
  }

 private:
  /// A row with the Jacobian of this joint and its response.
  [[nodiscard]] btMultiBodySolverConstraint MakePattern(btMultiBodyJacobianData& data) const {
    constexpr int kSize = JointInertia::kCoordinates;
    const int at = data.m_jacobians.size(), own = 6 + m_bodyA->getLink(m_linkA).m_dofOffset;
    data.m_jacobians.resize(at + kSize, 0.0);
    data.m_jacobians[at + own] = 1.0;
    data.m_deltaVelocitiesUnitImpulse.resize(at + kSize);
    for (int i = 0; i < kSize; ++i) data.m_deltaVelocitiesUnitImpulse[at + i] = response_[i];
    if (m_bodyA->getCompanionId() < 0) {
      m_bodyA->setCompanionId(data.m_deltaVelocities.size());
      data.m_deltaVelocities.resize(data.m_deltaVelocities.size() + kSize, 0.0);
    }
    const btVector3 none(0.0, 0.0, 0.0);
    btMultiBodySolverConstraint row;
    row.m_multiBodyA = m_bodyA;
    row.m_linkA = m_linkA;
    row.m_deltaVelAindex = m_bodyA->getCompanionId();
    row.m_jacAindex = at;
    // Forces that Bullet reports of its rows; nobody reads them.
    row.m_relpos1CrossNormal = row.m_contactNormal1 = none;
    row.m_relpos2CrossNormal = row.m_contactNormal2 = none;
    row.m_jacDiagABInv = 1.0 / response_[own];
    row.m_rhsPenetration = 0.0;
    row.m_cfm = 0.0;
    row.m_appliedImpulse = 0.0;
    return row;
  }

  void Add(Row index, const RowLaw& law, btMultiBodyConstraintArray& rows,
           btMultiBodyJacobianData& data) {
    if (!pattern_) pattern_ = MakePattern(data);
    internalSetAppliedImpulse(index, guess_[static_cast<std::size_t>(index)]);
    btMultiBodySolverConstraint& row = rows.expandNonInitializing();
    row = *pattern_;
    row.m_orgConstraint = this;
    row.m_orgDofIndex = index;
    row.m_rhs = (law.target_radps - m_bodyA->getJointVel(m_linkA)) * row.m_jacDiagABInv;
    row.m_lowerLimit = law.low_Nms;
    row.m_upperLimit = law.high_Nms;
  }

  const core::JointDescription& joint_;
  double damping_Nms_per_rad_, friction_Nm_;
  double q_rad_ = 0.0, qd_radps_ = 0.0;  // at the start of the step
  JointInertia::Velocities response_ = JointInertia::Velocities::Zero();
  std::optional<btMultiBodySolverConstraint> pattern_;  // of this step
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

void JointRows::Prepare(const RobotState& state, const JointInertia& inertia,
                        const JointRowImpulses& guess) {
  const auto q = Flatten(state.q), qd = Flatten(state.qd);
  for (std::size_t i = 0; i < kNumJoints; ++i)
    drives_[i]->Prepare(q[i], qd[i], inertia.responses(), guess[i]);
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
