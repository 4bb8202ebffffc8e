// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/wbc/whole_body_controller.h"

namespace scoria::controller {

/// Leg by leg, without optimisation: the planned forces through Jᵀ with the legs' own dynamics, and
/// joint controllers that hold stance feet where the body target wants them and swing feet on their
/// path. Source: the reference framework's choice for its own robot; differs: leg gravity and
/// inertia are fed forward, and the rotation of the trunk enters foot velocities with the right
/// sign.
class InverseDynamics final : public WholeBodyController {
 public:
  /// `robot` is borrowed.
  InverseDynamics(const InverseDynamicsParams& params, const core::RobotDescription& robot)
      : params_(params),
        effort_Nm_(robot.EffortLimits()),
        damping_m_(0.02 * robot.similarity.length) {}

  [[nodiscard]] WbcResult Solve(const WbcInput& in) noexcept override;
  [[nodiscard]] std::unique_ptr<WholeBodyController> Clone() const override {
    return std::make_unique<InverseDynamics>(*this);
  }

 private:
  /// Where a foot's centre shall be relative to the trunk's origin, in W.
  struct FootMotion {
    Vec3 p_BF_W, v_BF_W, a_BF_W;
  };
  [[nodiscard]] FootMotion Stance(const WbcInput& in, Leg leg,
                                  const BodyReference::Stage& target) const noexcept;
  [[nodiscard]] FootMotion Swing(const WbcInput& in, Leg leg) const noexcept;

  InverseDynamicsParams params_;
  LegArray<Vec3> effort_Nm_;
  double damping_m_;  // of the inverse Jacobian
};

}  // namespace scoria::controller
