// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/survival_plot.h"

#include <fmt/format.h>

#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

using Rows = std::vector<std::vector<double>>;

/// Columns: length, survival, low, high; two rows for every step, before and after it.
Rows StepRows(const SurvivalCurve& curve) {
  Rows rows = {{0.0, 1.0, 1.0, 1.0}};
  const auto add = [&](double length) {
    rows.push_back(rows.back());
    rows.back()[0] = length;
  };
  for (const SurvivalStep& step : curve.steps) {
    add(step.length);
    rows.push_back({step.length, step.survival, step.band.low, step.band.high});
  }
  add(curve.end);
  return rows;
}

Rows CensoredRows(const SurvivalCurve& curve) {
  Rows rows;
  for (const double length : curve.censored) {
    double survival = 1.0;
    for (const SurvivalStep& step : curve.steps) {
      if (step.length <= length) survival = step.survival;
    }
    rows.push_back({length, survival});
  }
  return rows;
}

/// Adds an arm's data. @returns its piece of the plot command.
std::string AddSeries(const SurvivalSeries& series, std::size_t arm, Figure& figure) {
  const std::string id = fmt::format("s{}", arm), colour = StyleOfArm(arm).colour;
  figure.Data(id, StepRows(series.curve));
  std::string piece = fmt::format(
      "${0} u 1:3:4 w filledcurves fc rgb '{1}' fs transparent solid 0.15 notitle, ${0} u 1:2 w l "
      "lw 2 lc rgb '{1}' t '{2}'",
      id, colour, Escape(series.arm));
  if (series.curve.censored.empty()) return piece;
  figure.Data(id + "c", CensoredRows(series.curve));
  return piece + fmt::format(", ${}c u 1:2 w p pt 1 ps 0.7 lc rgb '{}' notitle", id, colour);
}

}  // namespace

Figure DrawSurvival(const SurvivalPlot& plot) {
  Figure figure(plot.name, plot.title);
  std::string pieces;
  for (std::size_t arm = 0; arm < plot.series.size(); ++arm) {
    const SurvivalCurve& curve = plot.series[arm].curve;
    if (curve.steps.empty() && curve.censored.empty()) continue;
    pieces += (pieces.empty() ? "" : ", ") + AddSeries(plot.series[arm], arm, figure);
  }
  figure.Line(fmt::format("set xlabel '{}'; set ylabel '{}'; set title '{}'", Escape(plot.x_label),
                          Escape(plot.y_label), Escape(plot.title)));
  figure.Line("set key bottom left; set xrange [0:*]; set yrange [0:1.02]");
  figure.Line("plot " + pieces);
  return figure;
}

}  // namespace scoria::analysis
