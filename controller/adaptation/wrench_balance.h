// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/adaptation/model_adapter.h"
#include "controller/model/lag.h"
#include "core/math/delay_line.h"
#include "core/robot/description.h"
#include "core/robot/whole_body.h"

namespace scoria::controller {

/// Wrenches about B's origin, in B, as means over some steps:
///   wrench = nominal + Y Δπ,   Δπ = [Δm; Δ(m c_x); Δ(m c_y)] of a point mass at a known height.
struct WrenchSample {
  Vec6 wrench = Vec6::Zero();   // of all feet: [Σ f; Σ p_BF × f]
  Vec6 nominal = Vec6::Zero();  // that moves the unloaded robot as it moves
  Mat63 Y = Mat63::Zero();
  Vec3 s_B = Vec3::Zero();  // specific force of B's origin
  int steps = 0, steps_without_contact = 0;
  int steps_at_stop = 0;  // a joint leaned on its stop, whose torque no motor tells
};

struct WrenchBalanceParams {
  double gravity_mps2 = 9.81;
  double payload_height_m = 0.0;
  double presliding_rad = 0.0;  // 0: friction as the observer has it
  ObserverParams observer;
};

/// The trunk's rows of the equations of motion (WholeBody), from foot forces, joint speeds and IMU:
///   Σ J_Blᵀ f_l = H_BB a_B + Σ H_Bl qdd_l + h_B.
/// In B the attitude drops out: gravity and the trunk's acceleration enter as what the
/// accelerometer reads. The foot forces are those of the momentum observer, which lag; everything
/// they are compared with, even the places of the feet, takes the same delay and low passes, so
/// that neither an impact nor a foot that travels reads as mass.
///
/// The observer's forces act at the centres of the foot spheres; the ground's act where these
/// touch. On a slope of 10 deg the difference is a quarter of a kilogram for a Go2.
///
/// A joint at rest keeps Coulomb friction of the way it came: a robot that sank under a load and
/// stands hangs partly on its friction, by up to a kilogram. The observer's friction is zero at
/// rest; here it follows Dahl's model, d(x) = d(q) / presliding within [-1, 1], t_f = x friction.
/// Source: [Dahl1968], piecewise linear.
class WrenchBalance {
 public:
  /// `robot` is borrowed.
  WrenchBalance(const WrenchBalanceParams& params, const core::RobotDescription& robot) noexcept;

  /// One physics step. @returns false, and forgets nothing, if what it is given is not
  /// finite.
  bool Add(const AdapterInput& in) noexcept;
  /// The mean since the last Take.
  [[nodiscard]] WrenchSample Take() noexcept;
  /// After a pause: filters start from the next step's values.
  void Restart() noexcept;

  /// The unloaded robot at the last step.
  [[nodiscard]] const core::WholeBody& nominal() const noexcept { return wb_; }

 private:
  static constexpr int kPrompt = 31;  // nominal wrench 6, s_B 3, A 9, p_BF_B 12, at a stop 1
  using Prompt = Eigen::Matrix<double, kPrompt, 1>;
  struct Signals {
    Prompt prompt = Prompt::Zero();
    Vec6 speed = Vec6::Zero();  // of the change of the joint speeds
  };
  [[nodiscard]] Signals CalcSignals(const AdapterInput& in) noexcept;
  void Slide(const RobotState& state) noexcept;
  void Filter(const Signals& now, double dt_s) noexcept;
  [[nodiscard]] Vec3 CalcStiction(Leg leg, const RobotState& state) const noexcept;
  [[nodiscard]] bool IsAtStop(const RobotState& state) const noexcept;
  [[nodiscard]] Vec3 CalcGroundNormal_W() const noexcept;
  [[nodiscard]] Vec3 MoveToContact(Leg leg, const Vec3& f_F_W, const Vec3& p_FK_W) const noexcept;

  WrenchBalanceParams params_;
  const core::RobotDescription& robot_;
  core::WholeBodyModel model_;
  core::WholeBody wb_;
  core::DelayLine<Signals> signals_{kLongestLag};
  LowPassChain<kPrompt> prompt_;
  LowPassChain<6> speed_;
  Vec3 w_WS_S_ = Vec3::Zero();
  LegArray<Vec3> q_ = ZeroPerLeg(), qd_ = ZeroPerLeg();
  LegArray<Vec3> slid_ = ZeroPerLeg();  // x of Dahl's model
  bool started_ = false;
  WrenchSample sum_;
};

}  // namespace scoria::controller
