// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/estimation/rest_attitude.h"
#include "controller/estimation/state_estimator.h"

namespace scoria::controller {

/// Baseline. Attitude: gyroscope, pulled towards measured gravity. Position and velocity: Kalman
/// filter over [p_WB; v_WB; p_WF of four feet] with the accelerometer as input; a standing foot
/// does not move. All noises are isotropic, so the three axes share one covariance (6x6) and one
/// gain.
class LinearKf final : public StateEstimator {
 public:
  /// `robot` is borrowed.
  LinearKf(const LinearKfParams& params, const core::RobotDescription& robot, double gravity_mps2,
           const Placement& placement) noexcept;

  [[nodiscard]] StateEstimate Update(const EstimatorInput& in,
                                     Counters& counters) noexcept override;

  void Continue(const StateEstimate& from, double sigma_scale) noexcept override;

  [[nodiscard]] std::unique_ptr<StateEstimator> Clone() const override {
    return std::make_unique<LinearKf>(*this);
  }

 private:
  using Row = Eigen::Matrix<double, 1, 6>;
  using States = Eigen::Matrix<double, 6, 3>;  // one column per axis of W

  void Start(const RobotState& state) noexcept;
  void Turn(const EstimatorInput& in) noexcept;
  void Predict(const EstimatorInput& in) noexcept;
  void Correct(const EstimatorInput& in) noexcept;
  void CorrectBy(const Row& h, const Vec3& measured_W, double sigma) noexcept;

  LinearKfParams params_;
  const core::RobotDescription& robot_;
  double gravity_mps2_;
  Placement placement_;
  RestAttitude rest_;
  bool started_ = false;
  Mat3 R_WB_ = Mat3::Identity();
  Vec3 gyro_bias_S_ = Vec3::Zero(), w_WB_B_ = Vec3::Zero();
  States x_ = States::Zero();
  Mat6 P_ = Mat6::Zero();
};

}  // namespace scoria::controller
