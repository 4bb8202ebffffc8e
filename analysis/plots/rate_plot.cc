// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/rate_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/plots/gnuplot.h"
#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

/// Arms are set side by side so that their intervals do not cover each other.
double Shift(const RatePlot& plot, std::size_t arm) {
  if (plot.x.size() < 2) return 0.0;
  const double spacing = (plot.x.back() - plot.x.front()) / static_cast<double>(plot.x.size() - 1);
  const double middle = 0.5 * static_cast<double>(plot.series.size() - 1);
  return 0.06 * spacing * (static_cast<double>(arm) - middle);
}

/// Adds an arm's data. @returns its piece of the plot command.
std::string AddSeries(const RatePlot& plot, std::size_t arm, Figure& figure) {
  std::vector<std::vector<double>> seen, none;
  for (std::size_t i = 0; i < plot.x.size(); ++i) {
    const std::optional<RateEstimate>& rate = plot.series[arm].rates[i];
    if (!rate) continue;
    const double x = plot.x[i] + Shift(plot, arm);
    if (rate->events > 0) {
      seen.push_back({x, rate->rate, rate->interval.low, rate->interval.high});
    } else {
      none.push_back({x, rate->interval.high});
    }
  }
  if (seen.empty()) seen.push_back({kGap, kGap, kGap, kGap});
  if (none.empty()) none.push_back({kGap, kGap});
  const std::string id = fmt::format("a{}", arm);
  figure.Data(id, seen);
  figure.Data(id + "n", none);
  return fmt::format(
      "${0} u 1:2:3:4 w yerrorlines lc rgb '{1}' pt {2} ps 0.8 lw 1.5 t '{3}', ${0}n u 1:2 w p pt "
      "{4} ps 1.2 lc rgb '{1}' notitle",
      id, StyleOfArm(arm).colour, static_cast<int>(Symbol::kDisc), Escape(plot.series[arm].arm),
      static_cast<int>(Symbol::kTriangleDown));
}

/// Below what is shown; nothing where nothing is.
std::optional<double> LowestY(const RatePlot& plot) {
  std::optional<double> lowest;
  for (const RateSeries& s : plot.series) {
    for (const std::optional<RateEstimate>& rate : s.rates) {
      if (!rate) continue;
      const double y = rate->events > 0 ? rate->interval.low : 0.3 * rate->interval.high;
      lowest = std::min(lowest.value_or(1.0), y);
    }
  }
  return lowest;
}

}  // namespace

Figure DrawRates(const RatePlot& plot) {
  Figure figure(plot.name, plot.title);
  std::string pieces;
  for (std::size_t arm = 0; arm < plot.series.size(); ++arm)
    pieces += (arm > 0 ? ", " : "") + AddSeries(plot, arm, figure);
  figure.Line(fmt::format("set xlabel '{}'; set ylabel '{}'; set title '{}'", Escape(plot.x_label),
                          Escape(plot.y_label), Escape(plot.title)));
  const std::optional<double> lowest = LowestY(plot);
  if (!lowest) {
    figure.Line("set label 1 'nothing walked' at graph 0.5, graph 0.5 center");
    figure.Line("plot [0:1][0:1] NaN notitle");
    return figure;
  }
  figure.Line("set key top left; set logscale y; set format y '%g'");
  figure.Line(fmt::format("set yrange [{:.3g}:*]; set offsets graph 0.04, graph 0.04, 0, 0",
                          0.7 * *lowest));
  figure.Line("plot " + pieces);
  return figure;
}

}  // namespace scoria::analysis
