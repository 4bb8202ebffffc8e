// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/robot/whole_body.h"
#include "sim/plant/engine.h"

namespace scoria::sim {

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

  /// @param contacts    impulses are returned in place.
  /// @returns the velocities [v_WB; w_WB; qd] after the step.
  [[nodiscard]] Vec18 Solve(const StepInput& in, std::span<ContactPoint> contacts);

  /// Forgets the last step, from whose impulses the next one starts.
  void Reset() noexcept { friction_guess_.fill(0.0); }

  /// Of the last step.
  [[nodiscard]] int iterations() const noexcept { return iterations_; }
  /// Of friction and limits of the joints in the last step, N m s.
  [[nodiscard]] LegArray<Vec3> JointImpulses() const noexcept;

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
    int joint = 0;  // of row.leg
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

  const core::RobotDescription& robot_;
  SolverParams params_;
  LegArray<Mat3> L_ll_ = LegArray<Mat3>(Mat3::Zero());  // diagonals of the factor are inverted
  LegArray<Mat63> L_Bl_ = LegArray<Mat63>(Mat63::Zero());
  Mat6 L_BB_ = Mat6::Zero();
  Whitened v_;
  std::vector<ContactRows> contacts_;
  std::vector<JointRow> joints_;                     // friction of all joints, then limits
  std::array<double, kNumJoints> friction_guess_{};  // impulses of the last step
  int iterations_ = 0;
};

}  // namespace scoria::sim
