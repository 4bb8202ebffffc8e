// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/robot/whole_body.h"

namespace scoria::sim {

/// A point at which the ground may push on a body during one step. Along the normal the ground is
/// a spring and a damper that can only push; along the surface it is Coulomb friction, behind a
/// shear spring where the ground yields before it slips.
struct ContactPoint {
  int body = 0;  // as core::BodyIndex, 0 the trunk
  bool is_foot = false;
  Vec3 p_BP_W = Vec3::Zero();  // from B's origin
  Vec3 n_W = Vec3::UnitZ();    // out of the ground
  double gap_m = 0.0;          // < 0 inside the ground
  double friction = 0.0;
  double stiffness_N_per_m = 0.0;
  double damping_Ns_per_m = 0.0;
  double rest_m = 0.0;                   // penetration at which the spring is slack
  double shear_stiffness_N_per_m = 0.0;  // 0: rigid up to the friction limit
  Vec3 shear_W = Vec3::Zero();           // displacement of the shear spring, m
  Vec3 impulse_W = Vec3::Zero();         // N s on the robot; a guess before, the solution after
  Vec3 v_W = Vec3::Zero();               // of the point after the step
};

struct SolverParams {
  int max_iterations = 100;
  double residual = 1e-14;  // of squared velocity, m^2/s^2
};

/// Work done on the robot, J: impulse times the mean of the velocities before and after.
struct Work {
  double motor_J = 0.0, joint_J = 0.0, contact_J = 0.0, external_J = 0.0;
  Work& operator+=(const Work& w) noexcept {
    motor_J += w.motor_J;
    joint_J += w.joint_J;
    contact_J += w.contact_J;
    external_J += w.external_J;
    return *this;
  }
  bool operator==(const Work&) const = default;
};

/// Velocity of a quadruped after one semi-implicit Euler step: projected Gauss-Seidel on the
/// impulses of contacts, joint friction and joint limits. Rotor inertia A and viscous joint damping
/// D act as if the mass matrix were H + A + D dt, so the free motion solves
///   (H + A + D dt) v* = (H + A) v + dt (τ − h)
/// exactly. With the Cholesky factor H + A + D dt = L Lᵀ, legs before trunk, a row J of the
/// constraint Jacobian becomes y = L⁻¹Jᵀ, which has entries for one leg and the trunk only: 9
/// of 18. Source: [Featherstone2008] ch. 6 for the sparse factor.
class StepSolver {
 public:
  /// `robot` is borrowed.
  StepSolver(const core::RobotDescription& robot, const SolverParams& params);

  /// @param wb          H + A, h and kinematics at the start of the step.
  /// @param tau_Nm      motor torques.
  /// @param wrench_B_W  external force and moment about B's origin on the trunk.
  /// @param contacts    impulses are returned in place.
  /// @returns the velocities [v_WB; w_WB; qd] after the step.
  [[nodiscard]] Vec18 Solve(const core::WholeBody& wb, const LegArray<Vec3>& tau_Nm,
                            const Vec6& wrench_B_W, double dt_s, std::span<ContactPoint> contacts);

  /// Forgets the last step, from whose impulses the next one starts.
  void Reset() noexcept { friction_guess_.fill(0.0); }

  /// Of the last step.
  [[nodiscard]] const Work& work() const noexcept { return work_; }
  [[nodiscard]] int iterations() const noexcept { return iterations_; }

 private:
  /// A vector of generalised velocities or impulses in the coordinates of L, padded to whole SIMD
  /// registers.
  struct Whitened {
    Eigen::Matrix<double, 8, 1> trunk = Eigen::Matrix<double, 8, 1>::Zero();
    LegArray<Eigen::Vector4d> legs = LegArray<Eigen::Vector4d>(Eigen::Vector4d::Zero());
  };
  /// y · v + softness λ = target, for an impulse λ.
  struct Row {
    Eigen::Matrix<double, 8, 1> trunk = Eigen::Matrix<double, 8, 1>::Zero();
    Eigen::Vector4d own = Eigen::Vector4d::Zero();  // entries of `leg`
    Leg leg = Leg::kFL;
    double target = 0.0, softness = 0.0;
    double inverse_diagonal = 0.0;
    double impulse = 0.0;
  };
  struct ContactRows {
    Row normal, tangent1, tangent2;
    Vec3 tangent1_W, tangent2_W;
    double friction = 0.0;
  };
  /// A joint's friction or limit.
  struct JointRow {
    Row row;
    double low_Ns = 0.0, high_Ns = 0.0;
  };

  [[nodiscard]] static double Velocity(const Row& row, const Whitened& v) noexcept;
  static void Apply(const Row& row, double impulse, Whitened& v) noexcept;
  void Factorize(const core::WholeBody& wb, double dt_s);
  [[nodiscard]] Whitened ToWhitened(const Vec18& v) const noexcept;        // Lᵀ v
  [[nodiscard]] Vec18 FromWhitened(const Whitened& v) const noexcept;      // L⁻ᵀ v
  [[nodiscard]] Whitened SolveLower(const Vec18& impulse) const noexcept;  // L⁻¹ p
  [[nodiscard]] Row MakeRow(Leg leg, const Vec3& J_leg, const Vec6& J_trunk) const noexcept;
  [[nodiscard]] ContactRows MakeContact(const core::WholeBody& wb, const ContactPoint& c,
                                        double dt_s) const noexcept;
  void CollectRows(const core::WholeBody& wb, std::span<const ContactPoint> contacts, double dt_s);
  void AddLimits(Leg leg, int j, const RobotState& state, double dt_s);
  void Iterate();
  [[nodiscard]] double SolveContact(ContactRows& c) noexcept;
  [[nodiscard]] double SolveJoint(JointRow& j) noexcept;
  void SumWork(const Vec18& v_before, const Vec18& v_after, const LegArray<Vec3>& tau_Nm,
               const Vec6& wrench_B_W, double dt_s, const Whitened& before);

  const core::RobotDescription& robot_;
  SolverParams params_;
  LegArray<Mat3> L_ll_ = LegArray<Mat3>(Mat3::Zero());  // diagonals of the factor are inverted
  LegArray<Mat63> L_Bl_ = LegArray<Mat63>(Mat63::Zero());
  Mat6 L_BB_ = Mat6::Zero();
  Whitened v_;
  std::vector<ContactRows> contacts_;
  std::vector<JointRow> joints_;                     // friction of all joints, then limits
  std::array<double, kNumJoints> friction_guess_{};  // impulses of the last step
  Work work_;
  int iterations_ = 0;
};

}  // namespace scoria::sim
