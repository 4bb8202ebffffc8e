// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/leg_odometry_params.h"
#include "controller/estimation/rest_attitude.h"
#include "controller/estimation/state_estimator.h"

namespace scoria::controller {

/// Baseline without a filter. Attitude: the integrated gyroscope, less its bias at rest. Velocity:
/// the mean over the standing feet of that which keeps the foot's centre where it is; without a
/// standing foot the last one is held. Position: the integrated velocity. States no covariance.
class LegOdometry final : public StateEstimator {
 public:
  /// `robot` is borrowed.
  LegOdometry(const LegOdometryParams& params, const core::RobotDescription& robot,
              const Placement& placement) noexcept
      : robot_(robot), placement_(placement), rest_(params.rest) {}

  [[nodiscard]] StateEstimate Update(const EstimatorInput& in,
                                     Counters& counters) noexcept override;

  void Continue(const StateEstimate& from, double sigma_scale) noexcept override;

  [[nodiscard]] std::unique_ptr<StateEstimator> Clone() const override {
    return std::make_unique<LegOdometry>(*this);
  }

 private:
  const core::RobotDescription& robot_;
  Placement placement_;
  RestAttitude rest_;
  bool started_ = false;
  RobotState state_;
  Vec3 gyro_bias_S_ = Vec3::Zero();
};

}  // namespace scoria::controller
