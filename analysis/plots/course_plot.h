// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "analysis/plots/gnuplot.h"
#include "analysis/plots/style.h"

namespace scoria::analysis {

/// A quantity over time.
struct CourseLine {
  std::string label;
  std::vector<double> y;  // one per time of the plot, NaN for a gap
  const char* colour = Palette::kBlue;
  bool dashed = false;
};

/// An area between two quantities over time.
struct CourseBand {
  std::string label;
  std::vector<double> low, high;
  const char* colour = Palette::kBlue;
};

/// A bar over time while something holds.
struct CourseState {
  std::string label;
  std::vector<bool> holds;
};

/// Lines and bands, or states, one below the other.
struct CoursePanel {
  std::string y_label;
  std::vector<CourseBand> bands = {};
  std::vector<CourseLine> lines = {};
  std::vector<CourseState> states = {};
  const char* state_colour = Palette::kDarkGrey;
};

/// What happened over time, in panels below each other.
struct CoursePlot {
  std::string name, title;
  std::vector<double> time_s;
  std::vector<CoursePanel> panels;
  std::vector<double> marks_s = {};                         // dashed lines
  std::vector<std::pair<double, double>> stretches_s = {};  // shaded
  std::vector<std::pair<double, double>> gaps_s = {};       // by time: no line is drawn across
};

/// At most about 4000 instants are drawn; across a gap of more than a second, or one
/// that is named, there is no line.
/// Lines and bands without one value are left out.
[[nodiscard]] Figure DrawCourse(const CoursePlot& plot);

}  // namespace scoria::analysis
