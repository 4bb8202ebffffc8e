// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/adaptation/model_adapter.h"
#include "controller/adaptation/model_update_gate.h"

namespace scoria::controller {

/// The Kalman filter's recursion for π = [m; m c_x; m c_y] as a random walk with six measurements.
/// Source: [Paper] eqs. KF1 to KF5, in Joseph's form.
struct MassKalmanFilter {
  Vec3 pi = Vec3::Zero();
  Mat3 P = Mat3::Identity();

  /// @param Q  diagonal of the process noise of one step. @param R  of the measurement noise.
  void Update(const Mat63& Phi, const Vec6& z, const Vec3& Q, const Vec6& R) noexcept;
};

/// The paper's model adaptation:
///   m (v̇ + g) = Σ F,   c × m g = Σ r × F,   F = (Jᵀ)⁻¹ τ,
/// with massless legs, c_z = 0, no rotation, in heading axes (inertial ones up to the yaw, so that
/// c stays with the robot when it turns) and about B's origin, at single samples.
/// Source: [Paper] eqs. EOM1, EOM2, KF1 to KF5; differs: the axes' yaw, and v̇ + g is the IMU's
/// specific force, not moved to the centre of mass. Other leg forces or no acceleration can be
/// chosen, to tell what each costs.
class AdaptationKf final : public ModelAdapter {
 public:
  /// `robot` is borrowed.
  AdaptationKf(const AdaptationKfParams& params, const core::RobotDescription& robot,
               double gravity_mps2) noexcept;

  [[nodiscard]] const Adaptation& Update(const AdapterInput& in) noexcept override;

  void Continue(const core::ModelParameters& in_use) noexcept override;
  [[nodiscard]] std::unique_ptr<ModelAdapter> Clone() const override {
    return std::make_unique<AdaptationKf>(*this);
  }

 private:
  [[nodiscard]] Vec3 CalcFootForce_W(Leg leg, const AdapterInput& in) const noexcept;
  void Correct(const AdapterInput& in, double dt_s) noexcept;

  AdaptationKfParams params_;
  const core::RobotDescription& robot_;
  double gravity_mps2_;
  core::WholeBodyModel model_;
  core::WholeBody wb_;
  MassKalmanFilter filter_;
  ModelUpdateGate update_gate_;
  Adaptation out_;
  double since_s_ = 0.0;
};

}  // namespace scoria::controller
