// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"
#include "core/robot/state.h"

namespace scoria::core {

/// What the controller believes of the robot's inertia beyond its URDF; adaptation updates it.
struct ModelParameters {
  SpatialInertia trunk;  // in B
  bool operator==(const ModelParameters&) const = default;
};

/// Kinematics and dynamics of the floating-base robot at one state, split into the trunk and the
/// four legs, which meet only at the trunk. Generalised velocity v = [v_WB; w_WB; qd] with the
/// trunk part in W; generalised force [f; moment about B's origin; tau] likewise. Equations of
/// motion, foot forces f_F_W acting on the robot:
///   H_BB a + Σ H_Bl qdd_l + h_B = Σ J_Blᵀ f_l,      H_Blᵀ a + H_ll qdd_l + h_l = tau_l + J_llᵀ
///   f_l.
/// h holds Coriolis, centrifugal and gravity terms; H_ll includes the rotor inertia. All vectors in
/// W.
struct WholeBody {
  RobotState state;
  double mass_kg = 0.0;
  Vec3 p_WC = Vec3::Zero(), v_WC = Vec3::Zero();
  Mat3 I_C_W = Mat3::Zero();  // of the whole robot about C, joints locked
  Mat6 H_BB = Mat6::Zero();
  Vec6 h_B = Vec6::Zero();
  LegArray<Mat63> H_Bl;
  LegArray<Mat3> H_ll;
  LegArray<Vec3> h_l;

  LegArray<Vec3> p_WF, v_WF;  // foot sphere centres
  LegArray<Vec3> p_BF_W;      // from B's origin to the foot, in W
  LegArray<Mat3> J_ll;        // dv_WF / dqd_l; dv_WF / dv_B is [1, -Skew(p_BF_W)]
  LegArray<Mat3> p_BJ_W;      // joint origins from B's origin, as columns
  LegArray<Vec3> Jd_v;        // acceleration of F at a = 0, qdd = 0
  LegArray<Mat3> Jw_ll;       // dw_shank / dqd_l, the joint axes as columns
  LegArray<Vec3> w_shank_W;   // angular velocity of the shank
  LegArray<Vec3> Jwd_v;       // angular acceleration of the shank at a = 0, qdd = 0
};

/// Rigid-body dynamics of a quadruped. Cost: about 1 microsecond per Calc.
class WholeBodyModel {
 public:
  /// `robot` is borrowed.
  WholeBodyModel(const RobotDescription& robot, const Vec3& gravity_W);
  /// Gravity along -z of W.
  WholeBodyModel(const RobotDescription& robot, double gravity_mps2)
      : WholeBodyModel(robot, Vec3(0.0, 0.0, -gravity_mps2)) {}

  /// Replaces the trunk's inertia, as adaptation asks for.
  void SetParameters(const ModelParameters& parameters) noexcept;
  [[nodiscard]] const ModelParameters& parameters() const noexcept { return parameters_; }

  void Calc(const RobotState& state, WholeBody& out) const noexcept;

  [[nodiscard]] double gravity_mps2() const noexcept { return gravity_W_.norm(); }
  [[nodiscard]] const RobotDescription& robot() const noexcept { return robot_; }

 private:
  const RobotDescription& robot_;
  Vec3 gravity_W_;
  ModelParameters parameters_;
};

/// Foot centre in B and its Jacobian dp_BF/dq of one leg.
struct LegKinematics {
  Vec3 p_BF = Vec3::Zero();
  Mat3 J = Mat3::Zero();
};
[[nodiscard]] LegKinematics CalcLegKinematics(const LegDescription& leg, const Vec3& q) noexcept;

/// Joint angles that put the foot centre at p_BF, from `q_guess`, by damped Newton within the joint
/// limits. Returns the nearest pose found when p_BF is out of reach.
[[nodiscard]] Vec3 SolveLegIk(const LegDescription& leg, const Vec3& p_BF,
                              const Vec3& q_guess) noexcept;

/// Kinetic energy, J, of the rotors' turning against the links included.
[[nodiscard]] double CalcKineticEnergy(const WholeBody& wb) noexcept;

/// Linear momentum and angular momentum about the centre of mass, in W.
[[nodiscard]] Vec6 CalcMomentum(const WholeBody& wb) noexcept;

/// The 18x18 mass matrix and 18-vector h in the order [trunk; FL; FR; HL; HR], for tests and tools.
[[nodiscard]] Mat18 AssembleMassMatrix(const WholeBody& wb) noexcept;
[[nodiscard]] Vec18 AssembleBias(const WholeBody& wb) noexcept;

}  // namespace scoria::core
