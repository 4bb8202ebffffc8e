// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/inekf.h"
#include "controller/estimation/rest_attitude.h"
#include "controller/estimation/state_estimator.h"

namespace scoria::controller {

/// The invariant filter on this robot: starts from gravity at rest, sits at the IMU, lets round
/// feet roll and sink under load, and sets a foot that slips down anew.
class InekfEstimator final : public StateEstimator {
 public:
  /// `robot` is borrowed.
  InekfEstimator(const InekfEstimatorParams& params, const core::RobotDescription& robot,
                 double gravity_mps2, const Placement& placement) noexcept;

  [[nodiscard]] StateEstimate Update(const EstimatorInput& in,
                                     Counters& counters) noexcept override;

  void Continue(const StateEstimate& from, double sigma_scale) noexcept override;

  [[nodiscard]] std::unique_ptr<StateEstimator> Clone() const override {
    return std::make_unique<InekfEstimator>(*this);
  }

 private:
  void Start(const SensorFrame& z) noexcept;
  void Predict(const EstimatorInput& in, Counters& counters) noexcept;
  void MoveFeet(const EstimatorInput& in) noexcept;
  [[nodiscard]] InekfCorrection Correct(const EstimatorInput& in, Counters& counters) noexcept;
  void LiftSlippedFeet(const LegArray<FootMeasurement>& feet, double dt_s,
                       Counters& counters) noexcept;
  [[nodiscard]] StateEstimate Describe(const SensorFrame& z) const noexcept;

  InekfEstimatorParams params_;
  const core::RobotDescription& robot_;
  double gravity_mps2_;
  Placement placement_;
  RestAttitude rest_;
  Inekf filter_;
  bool started_ = false;
  LegArray<Vec3> mean_innovation_W_ = ZeroPerLeg();  // of each standing foot, over slip_window_s
  LegArray<double> touching_s_;
  LegArray<Vec3> mean_f_F_W_ = ZeroPerLeg();  // over load_change_s
  Vec3 w_WS_S_ = Vec3::Zero();
};

}  // namespace scoria::controller
