// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/adaptation/kf.h"
#include "controller/adaptation/model_adapter.h"
#include "controller/adaptation/model_update_gate.h"
#include "controller/adaptation/wrench_balance.h"

namespace scoria::controller {

/// What the wrench reads at the known mass beyond what it should. A share of it grows with the
/// load, as torque gains do; the rest is constant, as torque offsets are.
class Tare {
 public:
  explicit Tare(const TareParams& params) noexcept : params_(params) {}

  void Add(const WrenchSample& sample, double dt_s) noexcept;
  [[nodiscard]] bool done() const noexcept {
    return !params_.enabled || time_s_ >= params_.duration_s;
  }
  /// The misreading to be taken off a sample; the mean so far while not done.
  [[nodiscard]] Vec6 Calc(const WrenchSample& sample) const noexcept;

 private:
  TareParams params_;
  double time_s_ = 0.0;
  Vec6 error_ = Vec6::Zero();
  double load_N_ = 0.0;  // upward force read
};

/// Two-sided CUSUM over errors of Δπ, smoothed: has the payload changed?
class StepDetector {
 public:
  explicit StepDetector(const StepDetectionParams& params) noexcept : params_(params) {}

  [[nodiscard]] bool Update(const Vec3& error, double dt_s) noexcept;
  void Reset() noexcept;

 private:
  StepDetectionParams params_;
  Vec3 smooth_ = Vec3::Zero(), up_s_ = Vec3::Zero(), down_s_ = Vec3::Zero();
  double rest_s_ = 0.0;  // until the next change is looked for
};

/// Kalman filter of the excess Δπ = [Δm; Δ(m c_x); Δ(m c_y)] over the nominal robot in the full
/// floating-base balance (WrenchBalance), less a tare. Innovations beyond Huber's limit count
/// less; after a change of payload the covariance opens and the estimate settles anew.
class AdaptationKfPlus final : public ModelAdapter {
 public:
  /// `robot` is borrowed.
  AdaptationKfPlus(const KfPlusParams& params, const core::RobotDescription& robot,
                   double gravity_mps2, const ObserverParams& observer) noexcept;

  [[nodiscard]] const Adaptation& Update(const AdapterInput& in) noexcept override;
  void Continue(const core::ModelParameters& in_use) noexcept override;
  [[nodiscard]] std::unique_ptr<ModelAdapter> Clone() const override {
    return std::make_unique<AdaptationKfPlus>(*this);
  }

 private:
  void Correct(const WrenchSample& sample, double dt_s) noexcept;
  [[nodiscard]] Mat3 OpenCovariance() const noexcept;

  KfPlusParams params_;
  WrenchBalance balance_;
  Tare tare_;
  StepDetector detector_;
  MassKalmanFilter filter_;
  ModelUpdateGate update_gate_;
  Adaptation out_;
  double since_s_ = 0.0, at_work_s_ = 0.0;
};

}  // namespace scoria::controller
