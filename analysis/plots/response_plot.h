// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {

/// An arm's responses against one factor: single points, and a line through their means.
struct ResponseSeries {
  std::string arm;
  std::vector<std::array<double, 2>> points, means;
};

/// One factor.
struct ResponsePanel {
  std::string x_label;
  bool log = false;
  std::vector<ResponseSeries> series;  // one per arm of the campaign, in its order
};

struct ResponsePlot {
  std::string name, title, y_label;
  std::vector<ResponsePanel> panels;
};

/// Panels side by side. @pre some arm has points.
[[nodiscard]] Figure DrawResponses(const ResponsePlot& plot);

}  // namespace scoria::analysis
