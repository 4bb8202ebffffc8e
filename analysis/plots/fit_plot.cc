// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/fit_plot.h"

#include <fmt/format.h>

#include "analysis/plots/gnuplot.h"
#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

/// Adds a curve and its band. @returns its piece of the plot command.
std::string AddCurve(const FitSeries& series, std::size_t arm, Figure& figure) {
  const CurveFit& fit = series.fit;
  std::vector<std::vector<double>> curve;
  for (std::size_t i = 0; i < fit.x.size(); ++i) {
    curve.push_back({fit.x[i], fit.y[i], fit.low.empty() ? kGap : fit.low[i],
                     fit.high.empty() ? kGap : fit.high[i]});
  }
  figure.Data(fmt::format("f{}", arm), curve);
  return fmt::format(
      "$f{0} u 1:3:4 w filledcurves fc rgb '{1}' fs transparent solid 0.2 notitle, $f{0} u 1:2 w l "
      "lw 2 lc rgb '{1}' t '{2} (r^2 = {3:.2f}, n = {4})'",
      arm, StyleOfArm(arm).colour, Escape(series.arm), fit.r2, series.points.size());
}

/// Adds the points; only an arm without a curve names them. @returns its piece of the plot command.
std::string AddPoints(const FitSeries& series, std::size_t arm, Figure& figure) {
  std::vector<std::vector<double>> rows;
  for (const auto& [x, y] : series.points) rows.push_back({x, y});
  figure.Data(fmt::format("p{}", arm), rows);
  const std::string title =
      series.fit.valid ? "notitle" : fmt::format("t '{}'", Escape(series.arm));
  return fmt::format("$p{} u 1:2 w p pt {} ps 0.35 lc rgb '{}' {}", arm,
                     static_cast<int>(Symbol::kDisc), StyleOfArm(arm).colour, title);
}

}  // namespace

Figure DrawFits(const FitPlot& plot) {
  Figure figure(plot.name, plot.title);
  std::string points, curves;
  for (std::size_t arm = 0; arm < plot.series.size(); ++arm) {
    const FitSeries& series = plot.series[arm];
    if (series.points.empty()) continue;
    points += (points.empty() ? "" : ", ") + AddPoints(series, arm, figure);
    if (series.fit.valid) curves += ", " + AddCurve(series, arm, figure);
  }
  figure.Line("set key top right; set yrange [0:*]");
  figure.Line(fmt::format("set xlabel '{}'; set ylabel '{}'; set title '{}'", Escape(plot.x_label),
                          Escape(plot.y_label), Escape(plot.title)));
  figure.Line("plot " + points + curves);
  return figure;
}

}  // namespace scoria::analysis
