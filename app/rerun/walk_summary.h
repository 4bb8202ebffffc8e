// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/field/foothold_roughness.h"
#include "app/rerun/log_inputs.h"
#include "app/rerun/log_observer.h"
#include "logs/row.h"

namespace scoria::app {

/// Velocities in the heading frame, held for a while: a step of an operator's programme. Its clock
/// begins fall.stand_s after the walking controller is in charge, as an episode's.
struct HeldVelocity {
  double at_s = 0.0, v_x_mps = 0.0, v_y_mps = 0.0, w_z_radps = 0.0;
  double heading_rad = 0.0;  // at_s, turned since the start, as it was walked
};

/// Timing of the gait while the robot was to move.
struct GaitSummary {
  double period_s = 0.0, duty = 0.0;            // means
  double period_share = 0.0, duty_range = 0.0;  // scatter: deviation over mean, largest - least
  std::array<double, 4> offset{};               // of the phases from FL's, in shares of the period
};

/// What a scenario needs to know of a walk.
struct WalkSummary {
  double before_s = 0.0;    // of the log, until the walking controller is in charge
  double duration_s = 0.0;  // from then on
  bool commanded = false;   // velocities are the operator's; else those walked
  std::vector<HeldVelocity> velocities;
  std::optional<GaitSummary> gait;  // of the log's plan
  std::optional<double>
      swing_lift_m;  // median height of a swing over its begin, of those that end lower
  analysis::FootholdRoughness roughness;
  std::optional<double> mass_kg;  // learned without a tare: torques may misread
};

/// Goes over the log once, with an observer that learns the mass untared.
/// Errors: as logs::ForEachRow and SetUpVariant.
[[nodiscard]] WalkSummary SummariseWalk(const LogInputOptions& options, const LogInputs& inputs);

}  // namespace scoria::app
