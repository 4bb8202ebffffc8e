// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {

/// A bar for each arm, NaN for none.
struct Bars {
  std::string label;  // in the key of a panel with several
  std::vector<double> values;
};

struct BarPanel {
  std::string title;
  std::vector<Bars> bars;
};

struct BarPlot {
  std::string name, title;
  std::vector<std::string> arms;
  std::vector<BarPanel> panels;  // side by side
};

/// Bars from zero, an arm at each tick.
[[nodiscard]] Figure DrawBars(const BarPlot& plot);

}  // namespace scoria::analysis
