// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/statistics/cost_curve.h"

namespace scoria::analysis {

/// An arm's points (x, y) and the curve through them, if one could be fitted.
struct FitSeries {
  std::string arm;
  std::vector<std::array<double, 2>> points;
  CurveFit fit;
};

struct FitPlot {
  std::string name, title, x_label, y_label;
  std::vector<FitSeries> series;  // one per arm of the campaign, in its order
};

/// Points, curves with r² and their bands; y from zero. An arm without points is left out.
/// @pre  an arm has points.
[[nodiscard]] Figure DrawFits(const FitPlot& plot);

}  // namespace scoria::analysis
