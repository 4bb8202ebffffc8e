// SPDX-License-Identifier: BSD-3-Clause
#include "logs/mapping/signals.h"

namespace scoria::logs {

const std::array<SignalTraits, kNumSignals>& AllSignals() noexcept {
  using Id = SignalId;
  using Shape = SignalShape;
  constexpr SignalJoining kInterpolate = SignalJoining::kInterpolate;
  constexpr SignalJoining kHold = SignalJoining::kHold;
  static constexpr std::array<SignalTraits, kNumSignals> kSignals = {{
      {Id::kJointQ, "joints.q", Shape::kPerJoint, kInterpolate},
      {Id::kJointQd, "joints.qd", Shape::kPerJoint, kInterpolate},
      {Id::kJointTau, "joints.tau", Shape::kPerJoint, kInterpolate},
      {Id::kImuAttitude, "imu.attitude", Shape::kAttitude, kInterpolate},
      {Id::kImuRate, "imu.rate", Shape::kVector, kInterpolate},
      {Id::kImuAcceleration, "imu.acceleration", Shape::kVector, kInterpolate},
      {Id::kFootForce, "feet.force", Shape::kPerLeg, kInterpolate},
      {Id::kBatteryVoltage, "battery.voltage", Shape::kScalar, kInterpolate},
      {Id::kBatteryCurrent, "battery.current", Shape::kScalar, kInterpolate},
      {Id::kJointCommandQ, "joint_command.q", Shape::kPerJoint, kHold},
      {Id::kJointCommandQd, "joint_command.qd", Shape::kPerJoint, kHold},
      {Id::kJointCommandTau, "joint_command.tau", Shape::kPerJoint, kHold},
      {Id::kJointCommandKp, "joint_command.kp", Shape::kPerJoint, kHold},
      {Id::kJointCommandKd, "joint_command.kd", Shape::kPerJoint, kHold},
      {Id::kEstimatePosition, "estimate.position", Shape::kVector, kInterpolate},
      {Id::kEstimateVelocity, "estimate.velocity", Shape::kVector, kInterpolate},
      {Id::kEstimateAttitude, "estimate.attitude", Shape::kAttitude, kInterpolate},
      {Id::kTruthPosition, "truth.position", Shape::kVector, kInterpolate},
      {Id::kTruthVelocity, "truth.velocity", Shape::kVector, kInterpolate},
      {Id::kTruthRate, "truth.rate", Shape::kVector, kInterpolate},
      {Id::kTruthAttitude, "truth.attitude", Shape::kAttitude, kInterpolate},
      {Id::kTrueContact, "true_contacts.contact", Shape::kPerLeg, kHold},
      {Id::kTrueForce, "true_contacts.force", Shape::kVectorPerLeg, kInterpolate},
      {Id::kTrueFootPosition, "true_contacts.position", Shape::kVectorPerLeg, kInterpolate},
      {Id::kCommandVx, "command.v_x", Shape::kScalar, kHold},
      {Id::kCommandVy, "command.v_y", Shape::kScalar, kHold},
      {Id::kCommandWz, "command.w_z", Shape::kScalar, kHold},
      {Id::kPlanPeriod, "plan.period", Shape::kScalar, kHold},
      {Id::kPlanDuty, "plan.duty", Shape::kScalar, kHold},
      {Id::kPlanPhase, "plan.phase", Shape::kPerLeg, kHold},
      {Id::kPlanStance, "plan.stance", Shape::kPerLeg, kHold},
      {Id::kPlanFootTarget, "plan.foot_target", Shape::kVectorPerLeg, kHold},
      {Id::kReferencePosition, "reference.position", Shape::kVector, kHold},
      {Id::kReferenceVelocity, "reference.velocity", Shape::kVector, kHold},
      {Id::kReferenceAttitude, "reference.attitude", Shape::kAttitude, kHold},
      {Id::kContact, "contacts.contact", Shape::kPerLeg, kHold},
      {Id::kContactForce, "contacts.force", Shape::kVectorPerLeg, kInterpolate},
      {Id::kModelMass, "model.mass", Shape::kScalar, kHold},
      {Id::kModelCom, "model.com", Shape::kVector, kHold},
      {Id::kMpcTime, "solve_times.mpc", Shape::kScalar, SignalJoining::kEvent},
      {Id::kWbcTime, "solve_times.wbc", Shape::kScalar, SignalJoining::kEvent},
  }};
  return kSignals;
}

}  // namespace scoria::logs
