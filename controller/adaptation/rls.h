// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "controller/adaptation/model_adapter.h"
#include "controller/adaptation/model_update_gate.h"
#include "controller/adaptation/wrench_balance.h"

namespace scoria::controller {

/// Least squares of z = Φ π with weights forget^age, recursively: after any number of updates π
/// minimises  Σ forget^(n−i) |z_i − Φ_i π|²_{R⁻¹} + forget^n |π − π_0|²_{P_0⁻¹}.
struct ForgettingLeastSquares {
  Vec3 pi = Vec3::Zero();
  Mat3 information = Mat3::Identity();  // P⁻¹

  /// @param floor  least information, which forgetting cannot take away: P stays bounded without
  ///               excitation. Zero: pure exponential forgetting.
  void Update(const Mat63& Phi, const Vec6& z, const Vec6& R, double forget,
              const Vec3& floor) noexcept;
  [[nodiscard]] Mat3 P() const noexcept;
};

/// Recursive least squares of the whole robot's π = [m; m c_x; m c_y] in B, with exponential
/// forgetting, from the observer's foot forces (leg weight and motion accounted for):
///   Σ f = m s,   Σ p_BF × f = m c × s,   s = v̇_WB − g,   c_z the nominal robot's.
/// The trunk's turning and the legs' motion against it are left out: they average to nothing.
class RecursiveLeastSquares final : public ModelAdapter {
 public:
  /// `robot` is borrowed.
  RecursiveLeastSquares(const RlsParams& params, const core::RobotDescription& robot,
                        double gravity_mps2, const ObserverParams& observer) noexcept;

  [[nodiscard]] const Adaptation& Update(const AdapterInput& in) noexcept override;

  void Continue(const core::ModelParameters& in_use) noexcept override;
  [[nodiscard]] std::unique_ptr<ModelAdapter> Clone() const override {
    return std::make_unique<RecursiveLeastSquares>(*this);
  }

 private:
  void Correct(const WrenchSample& sample, double dt_s) noexcept;

  RlsParams params_;
  WrenchBalance balance_;
  ForgettingLeastSquares filter_;
  ModelUpdateGate update_gate_;
  Adaptation out_;
  double since_s_ = 0.0;
};

}  // namespace scoria::controller
