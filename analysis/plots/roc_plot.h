// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/plots/style.h"

namespace scoria::analysis {

/// Rates of a detector at one threshold.
struct RocSample {
  double false_positive = 0.0, true_positive = 0.0;
};

/// A detector at all of its thresholds.
struct RocCurve {
  std::string label;
  std::vector<RocSample> samples;
  double area = 0.0;
  bool dashed = false;
};

/// A detector at the threshold at which it is used.
struct RocMark {
  RocSample at;
  Symbol symbol = Symbol::kDisc;
};

struct RocSeries {
  std::vector<RocCurve> curves;
  std::vector<RocMark> marks;
};

struct RocPlot {
  std::string name, title, x_label, y_label;
  std::vector<RocSeries> series;  // one per arm of the campaign, in its order
};

/// Receiver operating characteristics, and beside them their upper left corner.
/// @pre  an arm has a curve.
[[nodiscard]] Figure DrawRoc(const RocPlot& plot);

}  // namespace scoria::analysis
