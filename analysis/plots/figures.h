// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/study/results.h"
#include "logs/read_rows.h"

namespace scoria::analysis {

/// A figure and the sentence below it.
struct CaptionedFigure {
  Figure figure;
  std::string caption;
};

/// Falls per metre against each numeric axis, one figure per combination of the other axes.
[[nodiscard]] std::vector<CaptionedFigure> FallFigures(const CampaignResults& results);

/// Cost of transport against speed, one point per steady window, fit, r² and bootstrap band:
/// mech_abs and electrical.
[[nodiscard]] std::vector<CaptionedFigure> CostFigures(const CampaignResults& results);

/// Tracking errors and solve times per arm.
[[nodiscard]] std::vector<CaptionedFigure> ArmFigures(const CampaignResults& results);

/// Height, speed, attitude and gait of one log over time, with falls marked.
[[nodiscard]] CaptionedFigure TimeFigure(const logs::LogContent& log, const std::string& name);

}  // namespace scoria::analysis
