// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <variant>

#include "core/config/archive.h"
#include "core/robot/state.h"

namespace scoria::controller {

/// Robot state and foot contacts as the controller believes them.
struct StateEstimate {
  RobotState state;
  LegArray<bool> contact;
};

/// One call per physics step.
class StateEstimator {
 public:
  virtual ~StateEstimator() = default;
  [[nodiscard]] virtual StateEstimate Update(const SensorFrame& z) noexcept = 0;
};

/// The simulator's own state, for controller studies without estimation error.
struct TruthEstimatorParams {
  static constexpr const char* kType = "truth";
  double touchdown_delay_s = 0.0;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("touchdown_delay_s", touchdown_delay_s,
            {.min = 0.0,
             .max = 0.5,
             .doc = "a foot counts as touching only after so long on the ground"});
  }
};

using EstimatorParams = std::variant<TruthEstimatorParams>;

/// @returns true if the estimator needs SensorFrame::truth.
[[nodiscard]] bool NeedsTruth(const EstimatorParams& params) noexcept;

[[nodiscard]] std::unique_ptr<StateEstimator> MakeStateEstimator(const EstimatorParams& params,
                                                                 double step_s);

}  // namespace scoria::controller
