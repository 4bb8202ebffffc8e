// SPDX-License-Identifier: BSD-3-Clause
#include "controller/safety/output_guard.h"

#include <algorithm>
#include <cmath>

namespace scoria::controller {

bool IsFinite(const JointCommand& c) noexcept {
  return std::all_of(kLegs.begin(), kLegs.end(), [&](Leg leg) {
    return c.q[leg].allFinite() && c.qd[leg].allFinite() && c.tau_Nm[leg].allFinite() &&
           c.kp_Nm_per_rad[leg].allFinite() && c.kd_Nms_per_rad[leg].allFinite();
  });
}

bool IsFinite(const ForcePlan& plan) noexcept {
  for (std::size_t k = 0; k < ForcePlan::kStages; ++k) {
    const BodyReference::Stage& body = plan.body[k];
    if (!body.rpy_rad.allFinite() || !body.p_WC.allFinite() || !body.w_WB.allFinite() ||
        !body.v_WC.allFinite())
      return false;
    for (const Leg leg : kLegs) {
      if (!plan.f_F_W[k][leg].allFinite() || !plan.f_next_F_W[leg].allFinite()) return false;
    }
  }
  return true;
}

ForcePlan StandInPlan(double weight_N, const LegArray<bool>& contact,
                      const BodyReference& reference, double stage_s) noexcept {
  ForcePlan plan;
  plan.valid = true;
  plan.dt_s = stage_s;
  const auto feet = std::count(contact.begin(), contact.end(), true);
  const Vec3 share =
      weight_N / static_cast<double>(std::max<std::ptrdiff_t>(feet, 1)) * Vec3::UnitZ();
  plan.f_next_F_W = LegArray<Vec3>(share);
  for (std::size_t k = 0; k < ForcePlan::kStages; ++k) {
    plan.body[k] = reference.stages[k];
    plan.stance[k] = contact;
    for (const Leg leg : kLegs) plan.f_F_W[k][leg] = contact[leg] ? share : Vec3::Zero();
  }
  return plan;
}

OutputGuard::OutputGuard(const SafetyParams& params, const core::RobotDescription& robot,
                         const LegArray<Vec3>& standing_rad)
    : robot_(robot), effort_Nm_(robot.EffortLimits()), standing_rad_(standing_rad) {
  set_params(params);
}

void OutputGuard::set_params(const SafetyParams& params) noexcept {
  params_ = params;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const core::JointDescription& joint = robot_.legs[leg].joints[static_cast<std::size_t>(j)];
      limits_.low_rad[leg][j] = joint.lower_rad + params.joint_margin_rad;
      limits_.high_rad[leg][j] = joint.upper_rad - params.joint_margin_rad;
    }
    const Vec3 low_rad = standing_rad_[leg] - params.working_range_rad;
    const Vec3 high_rad = standing_rad_[leg] + params.working_range_rad;
    working_.low_rad[leg] = limits_.low_rad[leg].cwiseMax(low_rad);
    working_.high_rad[leg] = limits_.high_rad[leg].cwiseMin(high_rad);
  }
}

JointCommand OutputGuard::Damping() const noexcept {
  JointCommand command;
  for (const Leg leg : kLegs) command.kd_Nms_per_rad[leg].setConstant(params_.damping_Nms_per_rad);
  return command;
}

/// Joints beyond their range that the command would push further out get a spring and
/// damper towards the inside instead. @returns how many.
int OutputGuard::TurnBackAtLimits(const JointRange& range, const SafetyParams& params,
                                  const RobotState& state, JointCommand& command) noexcept {
  int turned = 0;
  for (const Leg leg : kLegs) {
    for (int j = 0; j < kJointsPerLeg; ++j) {
      const double q = state.q[leg][j], qd = state.qd[leg][j];
      const double low = range.low_rad[leg][j], high = range.high_rad[leg][j];
      if (q >= low && q <= high) continue;
      const double tau = command.tau_Nm[leg][j] +
                         command.kp_Nm_per_rad[leg][j] * (command.q[leg][j] - q) +
                         command.kd_Nms_per_rad[leg][j] * (command.qd[leg][j] - qd);
      const bool inwards = q < low ? tau > 0.0 : tau < 0.0;
      if (inwards) continue;
      ++turned;
      command.tau_Nm[leg][j] = 0.0;
      command.q[leg][j] = q < low ? low : high;
      command.qd[leg][j] = 0.0;
      command.kp_Nm_per_rad[leg][j] = params.joint_limit_Nm_per_rad;
      command.kd_Nms_per_rad[leg][j] = params.joint_limit_Nms_per_rad;
    }
  }
  return turned;
}

JointCommand OutputGuard::Check(const JointCommand& command, const RobotState& state,
                                GuardMode mode, Counters& counters) noexcept {
  const bool tilted = !(state.R_WB(2, 2) >= std::cos(params_.tilt_stop_rad));  // also if not finite
  if (tilted && !tilted_ && !stopped_) counters.Add(Count::kTiltStop);
  tilted_ = tilted;
  stopped_ = stopped_ || (tilted && mode == GuardMode::kWalk);
  if (stopped_ || tilted || !IsFinite(command)) {
    counters.Add(Count::kDamping);
    return Damping();
  }
  JointCommand safe = command;
  for (const Leg leg : kLegs)
    safe.tau_Nm[leg] = safe.tau_Nm[leg].cwiseMax(-effort_Nm_[leg]).cwiseMin(effort_Nm_[leg]);
  const JointRange& range = mode == GuardMode::kWalk ? working_ : limits_;
  counters.Add(Count::kJointLimit,
               static_cast<std::uint64_t>(TurnBackAtLimits(range, params_, state, safe)));
  return safe;
}

}  // namespace scoria::controller
