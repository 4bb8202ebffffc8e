// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "app/rerun/log_inputs.h"
#include "controller/reference/reference_planner.h"
#include "controller/sensing.h"
#include "core/robot/counters.h"
#include "logs/row.h"

namespace scoria::app {

/// Sensing on the rows of a log. It starts at rest where the log begins at rest; else, after
/// kStartWait_s, in motion: with the attitude that the log has, and the velocity of the standing
/// feet. Where the log tells of its episode, it starts with the walking controller, and anew where
/// the robot was placed. After a gap of kGapPeriods rows it goes on, unsure, with the velocity of
/// the standing feet; after one of controller.samples.max_gap_s a new segment begins, too: how far
/// the robot went is not known.
class LogObserver {
 public:
  static constexpr double kStartWait_s = 0.3, kGapPeriods = 5.0;

  /// @param inputs  borrowed.
  LogObserver(const LogInputs& inputs, const controller::ControllerParams& params);

  /// @returns true once the estimate is started; else there is nothing to read yet.
  bool Step(const logs::Row& row);

  [[nodiscard]] const controller::Sensed& sensed() const noexcept { return sensing_->sensed(); }
  /// At the estimate.
  [[nodiscard]] const core::WholeBody& wb() const noexcept { return sensing_->wb(); }
  /// Counts starts and gaps: estimates of different segments are not one path.
  [[nodiscard]] std::uint32_t segment() const noexcept { return segment_; }
  [[nodiscard]] std::uint64_t gaps() const noexcept { return gaps_; }
  [[nodiscard]] bool started_in_motion() const noexcept { return started_in_motion_; }
  [[nodiscard]] const Counters& counters() const noexcept { return counters_; }

 private:
  void TakeSamples(const logs::Row& row);
  void TakePlan(const logs::PlanRow& row);
  void BeginAnew();
  [[nodiscard]] bool IsStarted(const logs::Row& row, double dt_s);
  void StartInMotion(const logs::Row& row);
  void GoOnAfterGap(double gap_s);
  void ContinueUnsure(controller::StateEstimate from);

  const LogInputs& inputs_;
  controller::ControllerParams params_;
  std::optional<controller::Sensing> sensing_;
  controller::ReferencePlanner ground_;
  SensorFrame z_;
  ContactPlan plan_;
  double plan_age_s_ = 0.0;
  double last_s_ = 0.0, waited_s_ = 0.0;
  bool first_ = true, operating_ = false, started_in_motion_ = false;
  std::uint32_t segment_ = 0;
  std::optional<std::uint32_t> logged_segment_;
  std::uint64_t gaps_ = 0;
  Counters counters_;
};

}  // namespace scoria::app
