// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/statistics/rate.h"

namespace scoria::analysis {

/// An arm's rate at each x of the plot; nothing where it has no exposure.
struct RateSeries {
  std::string arm;
  std::vector<std::optional<RateEstimate>> rates;
};

struct RatePlot {
  std::string name, title, x_label, y_label;
  std::vector<double> x;
  std::vector<RateSeries> series;  // one per arm of the campaign, in its order
};

/// Rates on a logarithmic axis, with bars for their intervals; a triangle at the upper bound where
/// there was no event.
[[nodiscard]] Figure DrawRates(const RatePlot& plot);

}  // namespace scoria::analysis
