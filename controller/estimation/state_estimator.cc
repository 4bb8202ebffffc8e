// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/state_estimator.h"

#include <cmath>

namespace scoria::controller {
namespace {

class TruthEstimator final : public StateEstimator {
 public:
  TruthEstimator(const TruthEstimatorParams& params, double step_s) noexcept
      : delay_steps_(std::lround(params.touchdown_delay_s / step_s)) {}

  StateEstimate Update(const SensorFrame& z) noexcept override {
    if (!z.truth) return last_;
    last_.state = z.truth->state;
    for (const Leg leg : kLegs) {
      touching_steps_[leg] = z.truth->contact[leg] ? touching_steps_[leg] + 1 : 0;
      last_.contact[leg] = touching_steps_[leg] > delay_steps_;
    }
    return last_;
  }

 private:
  std::int64_t delay_steps_;
  LegArray<std::int64_t> touching_steps_;
  StateEstimate last_;
};

}  // namespace

bool NeedsTruth(const EstimatorParams& params) noexcept {
  return std::holds_alternative<TruthEstimatorParams>(params);
}

std::unique_ptr<StateEstimator> MakeStateEstimator(const EstimatorParams& params, double step_s) {
  return std::visit(
      [step_s](const TruthEstimatorParams& p) -> std::unique_ptr<StateEstimator> {
        return std::make_unique<TruthEstimator>(p, step_s);
      },
      params);
}

}  // namespace scoria::controller
