// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/qp/dual_active_set.h"
#include "core/config/archive.h"
#include "core/robot/plans.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct TsidParams {
  double com_weight = 1.0, orientation_weight = 1.0, swing_weight = 1.0;
  double force_weight = 0.1;
  double regularisation = 1e-6;
  double com_kp = 100.0, com_kd = 20.0;
  double orientation_kp = 200.0, orientation_kd = 20.0;
  double swing_kp = 1200.0, swing_kd = 60.0, max_swing_acceleration_mps2 = 200.0;
  double contact_damping_per_s = 30.0;
  double friction = 0.45;
  double f_min_N = 2.0;
  double target_lead_s = 0.05;
  template <class Archive>
  void Serialize(Archive& a) {
    constexpr double kMaxWeight = 1e6, kMaxGain = 1e5;
    a.Field("com_weight", com_weight, {.min = 0.0, .max = kMaxWeight, .doc = "per (m/s^2)^2"});
    a.Field("orientation_weight", orientation_weight,
            {.min = 0.0, .max = kMaxWeight, .doc = "per (rad/s^2)^2"});
    a.Field("swing_weight", swing_weight, {.min = 0.0, .max = kMaxWeight, .doc = "per (m/s^2)^2"});
    a.Field("force_weight", force_weight, {.min = 0.0, .max = kMaxWeight, .doc = "per N^2"});
    a.Field("regularisation", regularisation, {.min = 1e-12, .max = 1.0});
    a.Field("com_kp", com_kp, {.min = 0.0, .max = kMaxGain, .doc = "1/s^2"});
    a.Field("com_kd", com_kd, {.min = 0.0, .max = kMaxGain, .doc = "1/s"});
    a.Field("orientation_kp", orientation_kp, {.min = 0.0, .max = kMaxGain});
    a.Field("orientation_kd", orientation_kd, {.min = 0.0, .max = kMaxGain});
    a.Field("swing_kp", swing_kp, {.min = 0.0, .max = kMaxGain});
    a.Field("swing_kd", swing_kd, {.min = 0.0, .max = kMaxGain});
    a.Field("max_swing_acceleration_mps2", max_swing_acceleration_mps2, {.min = 1.0, .max = 1e4});
    a.Field(
        "contact_damping_per_s", contact_damping_per_s,
        {.min = 0.0, .max = 80.0, .doc = "brakes a slipping foot; unstable near 100 at 500 Hz"});
    a.Field("friction", friction, {.min = 0.05, .max = 2.0, .doc = "assumed, of the pyramid"});
    a.Field("f_min_N", f_min_N, {.min = 0.0, .max = 1e3});
    a.Field("target_lead_s", target_lead_s,
            {.min = 0.0,
             .max = 0.2,
             .doc = "how far ahead on the MPC's predicted motion the body target lies"});
  }
};

struct WbcInput {
  const core::WholeBody& wb;
  const LegPhases& legs;
  const FootTargets& feet;
  const ForcePlan& forces;
  double plan_age_s;  // since the state that `forces` was planned from
  const Vec3& n_W;    // ground normal
};

struct WbcResult {
  JointCommand command;
  LegArray<Vec3> f_F_W = ZeroPerLeg();  // forces that the solution expects
  BodyReference::Stage target;          // body target of this tick
  SolveStatus status = SolveStatus::kNumerical;
  bool torque_rows_dropped = false;  // infeasible with torque limits: solved without, then clamped
  int iterations = 0;
};

/// Whole-body control by task-space inverse dynamics: tracks COM, trunk orientation, swing feet and
/// MPC forces in a weighted least-squares sense, subject to the equations of motion, non-moving
/// contacts, friction pyramids and torque limits. The null-space formulation eliminates the
/// equations of motion and the contacts, which leaves always twelve unknowns, z = force of each
/// stance foot or joint acceleration of each swing leg, and no equalities. Contacts roll: the
/// constrained point is the sphere's lowest one, not its centre. Source: paper, whole-body control.
class TsidNullspace {
 public:
  TsidNullspace(const TsidParams& params, const core::RobotDescription& robot);

  [[nodiscard]] WbcResult Solve(const WbcInput& in) noexcept;

 private:
  static constexpr int kVars = 12;
  static constexpr int kMaxRows = kNumLegs * 5 + 2 * kNumJoints;
  using Solver = DualActiveSet<kVars, kMaxRows>;
  using Mat3x12 = Eigen::Matrix<double, 3, 12>;

  /// Everything as an affine function of z.
  struct Reduction {
    Eigen::Matrix<double, 6, 12> trunk;  // trunk acceleration = trunk z + trunk_0
    Vec6 trunk_0;
    LegArray<Mat3x12> qdd, tau;
    LegArray<Vec3> qdd_0, tau_0;
  };

  void Reduce(const WbcInput& in) noexcept;
  void AddTask(const Mat3x12& A, const Vec3& target, double weight) noexcept;
  void AddTasks(const WbcInput& in, const BodyReference::Stage& target) noexcept;
  void BuildRows(const WbcInput& in, bool torque_limits) noexcept;

  TsidParams params_;
  const core::RobotDescription& robot_;
  LegArray<Vec3> effort_Nm_;
  Reduction z_;
  Mat12 G_;
  Vec12 g_;
  Solver::Rows A_;
  Solver::RowVector b_;
  Solver solver_;
  Solver::Result solution_;
};

}  // namespace scoria::controller
