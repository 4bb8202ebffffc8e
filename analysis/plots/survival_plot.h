// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/statistics/survival.h"

namespace scoria::analysis {

struct SurvivalSeries {
  std::string arm;
  SurvivalCurve curve;
};

struct SurvivalPlot {
  std::string name, title, x_label, y_label;
  std::vector<SurvivalSeries> series;  // one per arm of the campaign, in its order
};

/// Shares that survive, as steps with their bands; a cross where a lifetime was censored. An arm
/// without lifetimes is left out. @pre an arm has lifetimes.
[[nodiscard]] Figure DrawSurvival(const SurvivalPlot& plot);

}  // namespace scoria::analysis
