// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/roc_plot.h"

#include <fmt/format.h>

namespace scoria::analysis {
namespace {

/// Adds an arm's data. @returns its pieces of the plot command, each before a comma.
std::string AddSeries(const RocSeries& series, std::size_t arm, Figure& figure) {
  std::string pieces;
  const char* colour = StyleOfArm(arm).colour;
  for (std::size_t i = 0; i < series.curves.size(); ++i) {
    const RocCurve& curve = series.curves[i];
    std::vector<std::vector<double>> rows;
    for (const RocSample& s : curve.samples) rows.push_back({s.false_positive, s.true_positive});
    const std::string block = fmt::format("curve{}_{}", arm, i);
    figure.Data(block, rows);
    pieces += fmt::format("${} u 1:2 w l lw 2 dt {} lc rgb '{}' t '{} (AUC {:.4f})', ", block,
                          curve.dashed ? 2 : 1, colour, Escape(curve.label), curve.area);
  }
  for (std::size_t i = 0; i < series.marks.size(); ++i) {
    const RocMark& mark = series.marks[i];
    const std::string block = fmt::format("mark{}_{}", arm, i);
    figure.Data(block, {{mark.at.false_positive, mark.at.true_positive}});
    pieces += fmt::format("${} u 1:2 w p pt {} ps 1 lc rgb '{}' notitle, ", block,
                          static_cast<int>(mark.symbol), colour);
  }
  return pieces;
}

}  // namespace

Figure DrawRoc(const RocPlot& plot) {
  Figure figure(plot.name, plot.title, 1000, 520);
  std::string pieces;
  for (std::size_t arm = 0; arm < plot.series.size(); ++arm)
    pieces += AddSeries(plot.series[arm], arm, figure);
  pieces.resize(pieces.size() - 2);  // the last comma
  figure.Line("set multiplot layout 1,2; set clip two");
  figure.Line(
      fmt::format("set xlabel '{}'; set ylabel '{}'", Escape(plot.x_label), Escape(plot.y_label)));
  figure.Line("set key bottom right; set title 'Receiver operating characteristic'");
  figure.Line("plot [0:1][0:1] " + pieces);
  figure.Line("unset key; set title 'its corner'");
  figure.Line("plot [0:0.1][0.9:1] " + pieces);
  figure.Line("unset multiplot");
  return figure;
}

}  // namespace scoria::analysis
