// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "core/config/archive.h"
#include "core/robot/whole_body.h"

namespace scoria::sim {

/// A point mass that slides along one line of the trunk on a spring and a damper, without stops.
struct SlidingPayloadParams {
  std::string name;
  double mass_kg = 0.0;
  Vec3 p_BP_m = Vec3::Zero();
  Vec3 axis = Vec3::UnitY();
  double stiffness_N_per_m = 200.0;
  double damping_Ns_per_m = 2.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Required("name", name);
    a.Required("mass_kg", mass_kg, {.min = 0.01, .max = 50.0});
    a.Field("p_BP_m", p_BP_m, {.min = -2.0, .max = 2.0, .doc = "where the spring is slack, in B"});
    a.Field("axis", axis, {.doc = "direction of the line in B, of any length"});
    a.Field("stiffness_N_per_m", stiffness_N_per_m, {.min = 0.0, .max = 1e6});
    a.Field("damping_Ns_per_m", damping_Ns_per_m, {.min = 0.0, .max = 1e5});
  }
  [[nodiscard]] std::string Problem() const;
  bool operator==(const SlidingPayloadParams&) const = default;
};

/// Its one coordinate x rides beside the robot's eighteen and is eliminated from the step before
/// the solver sees it, so that contacts bear its inertia exactly. With r = p_BP_W, u the axis in W,
/// J = [1, −Skew(r)] and v_P = J v_B + u ẋ, one step is
///   (H + m JᵀJ) Δv + b Δẋ = dt (τ − h − Jᵀ m (β − g)),   b = m Jᵀu,
///   bᵀ Δv + (m + c dt) Δẋ = dt (−k x − c ẋ − m u·(β − g)),
/// β the acceleration of P at zero generalised acceleration. The damper acts implicitly, the spring
/// as semi-implicit Euler has it.
class SlidingPayload {
 public:
  SlidingPayload(const SlidingPayloadParams& params, const Vec3& gravity_W);

  /// Puts it at rest on the trunk with the spring slack.
  void Reset() noexcept { x_m_ = rate_mps_ = 0.0; }

  /// Adds what it does to the trunk in a step of `dt_s` to H_BB and h_B.
  void AddTo(core::WholeBody& wb, double dt_s) const noexcept;

  /// The share of H_BB that a sudden change of velocity meets, with x free.
  [[nodiscard]] Mat6 CalcImpactInertia(const RobotState& state) const noexcept;

  /// Advances by one step in which the trunk's velocity [v_WB; w_WB] changed from that of `before`
  /// by `change`. @returns the damper's work, J.
  double Step(const RobotState& before, const Vec6& change, double dt_s) noexcept;

  /// The trunk's velocity changed at once by `change`.
  void Kick(const RobotState& before, const Vec6& change) noexcept;

  [[nodiscard]] double mass_kg() const noexcept { return params_.mass_kg; }
  [[nodiscard]] double x_m() const noexcept { return x_m_; }
  [[nodiscard]] double rate_mps() const noexcept { return rate_mps_; }
  [[nodiscard]] Vec3 CalcPosition(const RobotState& state) const noexcept;  // p_WP
  [[nodiscard]] Vec3 CalcVelocity(const RobotState& state) const noexcept;  // v_WP
  [[nodiscard]] double CalcKineticEnergy(const RobotState& state) const noexcept;
  /// Of gravity from z = 0 and of the spring, where it was half a step ago, as velocities are.
  [[nodiscard]] double CalcPotentialEnergy(const RobotState& state, double dt_s) const noexcept;

 private:
  struct Coupling {
    Vec3 r_W, u_W, f_W;  // f = m (β − g)
    Vec6 b;
  };
  [[nodiscard]] Coupling CalcCoupling(const RobotState& state) const noexcept;
  [[nodiscard]] double SlideImpulse(const Coupling& c, double dt_s) const noexcept;
  [[nodiscard]] Mat6 LockedInertia(const Vec3& r_W) const noexcept;

  SlidingPayloadParams params_;
  Vec3 gravity_W_, axis_B_;
  double x_m_ = 0.0, rate_mps_ = 0.0;
};

}  // namespace scoria::sim
