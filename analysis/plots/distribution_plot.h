// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {

/// Values by rising share, evenly spaced from 0 to 1.
using QuantileCurve = std::vector<double>;

struct DistributionSeries {
  std::string label;
  std::vector<QuantileCurve> walks;  // each as long as the others
};

struct DistributionPlot {
  std::string name, title, x_label;
  std::vector<DistributionSeries> series;
};

/// Cumulative shares: a thin line for every walk of a set, and a thick one for the mean of their
/// quantiles. The axis ends where 99 % of every walk are. @pre every series has a walk.
[[nodiscard]] Figure DrawDistributions(const DistributionPlot& plot);

}  // namespace scoria::analysis
