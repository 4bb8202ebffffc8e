// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/robot/description.h"
#include "core/robot/legs.h"

namespace scoria::sim {

/// Rotor inertia A and viscous damping D of the joints, which Bullet's articulated bodies lack: the
/// answer of a robot to an impulse along j, H⁻¹ j by Bullet, becomes M⁻¹ j with M = H + A + dt D,
/// exactly. With E the joints among the coordinates, V = H⁻¹ E and r = √(A + dt D),
///   M⁻¹ = H⁻¹ − W Wᵀ,   W = V r L⁻ᵀ,   L Lᵀ = 1 + r (Eᵀ V) r.
/// As rows of the solver they couple as strongly as the links of a light leg do, and the iteration
/// does not come to its end.
/// Source: [Hager1989].
class JointInertia {
 public:
  /// Bullet's coordinates: w and v of the base, then the joints.
  static constexpr int kCoordinates = 6 + kNumJoints;
  using Velocities = Eigen::Matrix<double, kCoordinates, 1>;
  using Responses = Eigen::Matrix<double, kCoordinates, kNumJoints>;

  explicit JointInertia(const core::MotorParams& motors);

  /// For one step.
  /// @param V  response of the robot without rotors and dampers to a unit impulse of each joint.
  void Prepare(const Responses& V, double dt_s);

  /// With rotors and dampers, M⁻¹ E.
  [[nodiscard]] const Responses& responses() const noexcept { return responses_; }

  /// Turns a response H⁻¹ j into M⁻¹ j.
  /// @returns jᵀ H⁻¹ j − jᵀ M⁻¹ j, by how much the row's mobility becomes less.
  double Correct(const Eigen::Ref<const Velocities>& j,
                 Eigen::Ref<Velocities> response) const noexcept;

  /// What rotors and dampers change of the velocities after a step without them.
  /// @param before_radps, free_radps  speeds of the joints before and after that step.
  [[nodiscard]] Velocities FreeChange(const Vec12& before_radps,
                                      const Vec12& free_radps) const noexcept;

 private:
  Vec12 armature_kgm2_, damping_Nms_per_rad_;
  Vec12 resistance_kgm2_ = Vec12::Zero();  // A + dt D
  Responses W_ = Responses::Zero(), responses_ = Responses::Zero();
};

}  // namespace scoria::sim
