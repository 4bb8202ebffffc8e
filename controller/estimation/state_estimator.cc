// SPDX-License-Identifier: BSD-3-Clause
#include "controller/estimation/state_estimator.h"

namespace scoria::controller {
namespace {

class TruthEstimator final : public StateEstimator {
 public:
  StateEstimate Update(const SensorFrame& z) noexcept override {
    if (z.truth) last_ = {z.truth->state, z.truth->contact};
    return last_;
  }

 private:
  StateEstimate last_;
};

}  // namespace

bool NeedsTruth(const EstimatorParams& params) noexcept {
  return std::holds_alternative<TruthEstimatorParams>(params);
}

std::unique_ptr<StateEstimator> MakeStateEstimator(const EstimatorParams& params) {
  return std::visit(
      [](const TruthEstimatorParams&) -> std::unique_ptr<StateEstimator> {
        return std::make_unique<TruthEstimator>();
      },
      params);
}

}  // namespace scoria::controller
