// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/model/lag.h"
#include "core/config/field.h"
#include "core/math/delay_line.h"
#include "core/robot/description.h"
#include "core/robot/state.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

struct ObserverParams {
  double cutoff_Hz = 60.0;
  double gyro_cutoff_Hz = 100.0;
  double torque_delay_s = 0.002;
  double velocity_bandwidth_Hz = 125.0;
  bool viscous_friction = true;
  bool coulomb_friction = true;
  double coulomb_smooth_radps = 0.2;
  double singular_below_m = 0.1;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("cutoff_Hz", cutoff_Hz,
            {.min = 1.0, .max = 400.0, .doc = "gain of the momentum residual over 2 pi"});
    a.Field("gyro_cutoff_Hz", gyro_cutoff_Hz,
            {.min = 1.0,
             .max = 400.0,
             .doc = "low pass of the gyro, whose differences are the angular acceleration"});
    a.Field("torque_delay_s", torque_delay_s,
            {.min = 0.0,
             .max = 0.03,
             .doc = "the torque sample is that much older than the encoders; whole ticks"});
    a.Field(
        "velocity_bandwidth_Hz", velocity_bandwidth_Hz,
        {.min = 0.0,
         .max = 1e4,
         .doc = "of the tracking loop that gives the joint speeds; all else is filtered alike; 0: "
                "the speeds are immediate"});
    a.Field("viscous_friction", viscous_friction,
            {.doc = "subtract the robot's motors.damping_Nms_per_rad"});
    a.Field("coulomb_friction", coulomb_friction,
            {.doc = "subtract the robot's motors.friction_Nm"});
    a.Field("coulomb_smooth_radps", coulomb_smooth_radps,
            {.min = 1e-3,
             .max = 10.0,
             .doc = "the sign of the speed is tanh(speed / this): no chatter about rest",
             .scale = core::dimension::kRate});
    a.Field("singular_below_m", singular_below_m,
            {.min = 1e-4,
             .max = 0.5,
             .doc = "smallest singular value of a foot's Jacobian below which its force is damped",
             .scale = core::dimension::kLength});
  }
  bool operator==(const ObserverParams&) const = default;
};

struct ObserverInput {
  const core::WholeBody& wb;  // at this tick's state or the last one's
  const SensorFrame& z;
  double dt_s = 0.001;  // since the last call
};

/// Ground force on each foot, from the legs' generalised momentum with floating-base dynamics.
///
/// The leg rows of the equations of motion (WholeBody) with joint friction t_f are
///   H_Blᵀ a_B + H_ll qdd + h_l = tau − t_f + J_llᵀ f_F,         a_B = [v̇_WB; ẇ_WB].
/// The momentum residual ṙ = λ (ṗ_l − (tau − t_f + Ḣ v − h_l) − r) with p_l = H_Blᵀ v_B + H_ll qd
/// needs no accelerations. Since ṗ − Ḣ v = H v̇, it is the first-order low pass, gain λ, of
///   H_Blᵀ a_B + H_ll Δqd/Δt + h_l + t_f − tau  =  J_llᵀ f_F,
/// and this form is the one computed: it needs no Ḣ, and the trunk's acceleration may come from the
/// IMU instead of from an estimated velocity,
///   v̇_WB = R_WS a_S + g_W − ẇ × r − w × (w × r),   r = R_WB p_BS.
/// So neither a leg's weight nor a tilted or accelerating trunk reads as contact.
///
/// The terms must be of one time and one bandwidth, or a leg's own acceleration reads as contact:
/// the others wait for the torque sample, and what is not made of joint speeds passes the low pass
/// ω² / (s + ω)² that a critically damped tracking loop of natural frequency ω puts on those.
/// Source: [DeLuca2005], [Bledt2018]; differs: trunk acceleration from the IMU.
class MomentumObserver {
 public:
  /// `robot` is borrowed.
  MomentumObserver(const ObserverParams& params, const core::RobotDescription& robot,
                   double gravity_mps2) noexcept
      : params_(params), robot_(robot), g_W_(0.0, 0.0, -gravity_mps2) {}

  /// A leg whose readings or model are not finite keeps its force; all do without the IMU.
  /// @returns N, ground on foot, in W.
  const LegArray<Vec3>& Update(const ObserverInput& in) noexcept;
  /// [v̇_WB; ẇ_WB] of the last call, in W and without gravity.
  [[nodiscard]] const Vec6& a_B() const noexcept { return a_B_; }

 private:
  /// What stands against the motor torque, and the Jacobian at that time.
  struct Sample {
    LegArray<Vec3> t_prompt = ZeroPerLeg();  // trunk's acceleration, gravity, Coriolis
    LegArray<Vec3> t_speed = ZeroPerLeg();   // of the change of the joint speeds, and friction
    LegArray<Mat3> J{Mat3::Zero()};
  };
  [[nodiscard]] Vec6 CalcTrunkAcceleration(const ObserverInput& in) noexcept;
  [[nodiscard]] Vec3 CalcFriction(const Vec3& qd) const noexcept;
  void UpdateLeg(Leg leg, const Sample& then, const Vec3& tau_Nm, const Lag& lag) noexcept;

  ObserverParams params_;
  const core::RobotDescription& robot_;
  Vec3 g_W_;
  core::DelayLine<Sample> samples_{kLongestLag};
  Vec3 w_WS_S_ = Vec3::Zero();  // filtered
  Vec6 a_B_ = Vec6::Zero();
  LegArray<Vec3> qd_ = ZeroPerLeg();  // of the last call
  LegArray<LowPassChain<3>> t_f_;     // J_llᵀ f_F
  LegArray<Vec3> f_F_W_ = ZeroPerLeg();
  bool started_ = false;
};

/// The force f with Jᵀ f = t; below `singular_below_m` the least singular value is damped, so that
/// a stretched leg cannot turn torque noise into any force along itself.
[[nodiscard]] Vec3 CalcFootForce(const Mat3& J, const Vec3& t, double singular_below_m) noexcept;

/// Forces that hold the legs' weight and the motor torques at rest, f = −J⁻ᵀ (tau − gravity): what
/// remains of the observer without motion. For comparison.
/// @param wb_at_rest  the robot at its pose with all velocities zero.
[[nodiscard]] LegArray<Vec3> CalcQuasiStaticForces(const core::WholeBody& wb_at_rest,
                                                   const LegArray<Vec3>& tau_Nm,
                                                   double singular_below_m) noexcept;

}  // namespace scoria::controller
