// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "analysis/metrics/metric.h"
#include "analysis/signals/gait_timing.h"
#include "analysis/signals/path.h"
#include "analysis/signals/stance_slip.h"
#include "analysis/signals/steady.h"
#include "analysis/statistics/distribution.h"
#include "core/robot/description.h"
#include "logs/row.h"

namespace scoria::analysis {

/// What of a walk has a distribution, not only a mean: a magnitude for every row, stride, stance or
/// half-second chord in which the robot walks.
enum class Signal {
  kStride,
  kDuty,
  kFootForce,
  kTorqueUse,
  kSpeedUse,
  kSlip,
  kCost,
  kNis,
  kHeightError,
  kTiltError,
};
inline constexpr std::size_t kNumSignals = 10;
constexpr std::array<std::pair<Signal, std::string_view>, kNumSignals> EnumNames(Signal) {
  return {{{Signal::kStride, "stride"},
           {Signal::kDuty, "duty"},
           {Signal::kFootForce, "foot_force"},
           {Signal::kTorqueUse, "torque_use"},
           {Signal::kSpeedUse, "speed_use"},
           {Signal::kSlip, "slip"},
           {Signal::kCost, "cost"},
           {Signal::kNis, "nis"},
           {Signal::kHeightError, "height_error"},
           {Signal::kTiltError, "tilt_error"}}};
}

/// Title, units, and the groups of the rows that it needs; its definition is of one value.
[[nodiscard]] MetricInfo InfoOf(Signal signal);

/// Of one walk: those that it has values of.
using SignalDistributions = std::map<Signal, Distribution>;

/// Takes the rows of one walk, completed as those of metrics are.
class SignalAccumulator {
 public:
  /// @param robot  whose limits torque and speed are shares of; borrowed; null: not known, and they
  /// are left out.
  SignalAccumulator(double gravity_mps2, const core::RobotDescription* robot);
  void AddRow(const logs::Row& row);
  [[nodiscard]] const SignalDistributions& Finish() const noexcept { return out_; }

 private:
  void Add(Signal signal, double value) { out_[signal].Add(value); }
  void AddGait(const logs::Row& row);
  void AddEffort(const logs::Row& row);
  void AddCost(const logs::Row& row);
  void AddErrors(const logs::Row& row);
  void Break() noexcept;

  double gravity_mps2_;
  std::optional<logs::Array12> most_Nm_, most_radps_;
  SignalDistributions out_;
  bool walks_ = false;
  std::uint32_t segment_ = 0;
  double last_s_ = 0.0;
  GaitTimer gait_;
  StanceSlips slips_;
  PathLength path_;
  std::optional<double> chord_energy_J_;  // at its start
  SteadyCommand command_;
};

}  // namespace scoria::analysis
