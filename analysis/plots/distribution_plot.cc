// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/distribution_plot.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

constexpr double kShownShare = 0.99;

double ShareAt(std::size_t i, std::size_t count) {
  return static_cast<double>(i) / static_cast<double>(count - 1);
}

QuantileCurve MeanOf(const std::vector<QuantileCurve>& walks) {
  QuantileCurve mean(walks.front().size());
  for (const QuantileCurve& walk : walks) {
    for (std::size_t i = 0; i < mean.size(); ++i)
      mean[i] += walk[i] / static_cast<double>(walks.size());
  }
  return mean;
}

std::vector<std::vector<double>> RowsOf(const QuantileCurve& curve) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i < curve.size(); ++i)
    rows.push_back({curve[i], ShareAt(i, curve.size())});
  return rows;
}

double ShownEnd(const DistributionPlot& plot) {
  double end = 0.0;
  for (const DistributionSeries& series : plot.series) {
    for (const QuantileCurve& walk : series.walks) {
      for (std::size_t i = 0; i < walk.size(); ++i) {
        if (ShareAt(i, walk.size()) <= kShownShare) end = std::max(end, walk[i]);
      }
    }
  }
  return end;
}

/// Adds a set's data. @returns its pieces of the plot command: walks below, the mean above.
std::string AddSeries(const DistributionSeries& series, std::size_t set, Figure& figure) {
  const std::string colour = StyleOfArm(set).colour;
  std::string pieces;
  for (std::size_t walk = 0; walk < series.walks.size(); ++walk) {
    const std::string id = fmt::format("w{}_{}", set, walk);
    figure.Data(id, RowsOf(series.walks[walk]));
    pieces += fmt::format("${} u 1:2 w l lw 0.8 lc rgb '#90{}' notitle, ", id, colour.substr(1));
  }
  const std::string id = fmt::format("m{}", set);
  figure.Data(id, RowsOf(MeanOf(series.walks)));
  return pieces +
         fmt::format("${} u 1:2 w l lw 2.5 lc rgb '{}' t '{}'", id, colour, Escape(series.label));
}

}  // namespace

Figure DrawDistributions(const DistributionPlot& plot) {
  Figure figure(plot.name, plot.title, 900, 420);
  std::string pieces;
  for (std::size_t set = 0; set < plot.series.size(); ++set)
    pieces += (set > 0 ? ", " : "") + AddSeries(plot.series[set], set, figure);
  figure.Line(fmt::format("set xlabel '{}'; set ylabel 'share below'; set title '{}'",
                          Escape(plot.x_label), Escape(plot.title)));
  figure.Line(
      fmt::format("set key bottom right; set yrange [0:1]; set xrange [0:{}]", ShownEnd(plot)));
  figure.Line("plot " + pieces);
  return figure;
}

}  // namespace scoria::analysis
