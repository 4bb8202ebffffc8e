// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/config/field.h"
#include "core/robot/plans.h"

namespace scoria::controller {

/// Period, stance share and phase offsets that a gait asks for.
struct GaitTiming {
  double period_s = 0.5;
  double duty = 0.6;
  LegArray<double> offset{0.0, 0.5, 0.5, 0.0};
  bool operator==(const GaitTiming&) const = default;
};

/// Walk when someone commands motion or the body is pushed, stand otherwise.
struct StandParams {
  double stop_below_mps = 0.08;
  double step_above_mps = 0.30;
  double correct_above_m = 0.08;
  double correction_period_s = 0.6;
  template <class Archive>
  void Serialize(Archive& a) {
    a.Field("stop_below_mps", stop_below_mps,
            {.min = 0.0,
             .max = 2.0,
             .doc = "without a command, stand below this body speed",
             .scale = core::dimension::kSpeed});
    a.Field("step_above_mps", step_above_mps,
            {.min = 0.0,
             .max = 5.0,
             .doc = "without a command, start stepping above this speed",
             .scale = core::dimension::kSpeed});
    a.Field("correct_above_m", correct_above_m,
            {.min = 0.01,
             .max = 10.0,
             .doc = "a standing foot that is further from its place steps there, one at a time",
             .scale = core::dimension::kLength});
    a.Field("correction_period_s", correction_period_s,
            {.min = 0.25,
             .max = 5.0,
             .doc = "between two such steps; a third of it in the air",
             .scale = core::dimension::kTime});
  }
  bool operator==(const StandParams&) const = default;
};

/// The phase of every leg, kept consistent while the timing changes. Stage two of the adaptive gait
/// sequencer; with constant timing it is the clock of a fixed gait. Source: paper, adaptive gait
/// sequencer, phase update and offset correction. Differences: phases are rescaled to the new duty
/// factor before they advance, and a correction never moves a leg within one correction step of
/// lift-off (so it cannot cause one).
class PhaseEngine {
 public:
  /// One step of dt under `timing`; legs in `touched_down` end their swing at once. Without
  /// `walking`, feet that are down stay down and the others finish their swing.
  void Update(const GaitTiming& timing, double dt_s, bool walking,
              const LegArray<bool>& touched_down) noexcept;

  /// Out of standing: lifts one foot, which then swings under the timing of the next updates.
  void Step(Leg leg, const GaitTiming& timing) noexcept;

  /// The contact plan over `horizon` stages of `stage_s`, timing held constant.
  [[nodiscard]] ContactPlan Predict(int horizon, double stage_s) const noexcept;

  [[nodiscard]] const LegArray<double>& phase() const noexcept { return phase_; }
  [[nodiscard]] bool InStance(Leg leg) const noexcept { return phase_[leg] < timing_.duty; }
  [[nodiscard]] bool standing() const noexcept { return standing_; }

 private:
  void StartWalking() noexcept;
  [[nodiscard]] Leg ReferenceLeg() const noexcept;
  void CorrectOffsets(double dt_s) noexcept;

  GaitTiming timing_;
  LegArray<double> phase_{0.0};
  bool standing_ = true, walking_ = false;
};

}  // namespace scoria::controller
