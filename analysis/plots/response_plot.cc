// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/response_plot.h"

#include <fmt/format.h>

#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

std::vector<std::vector<double>> PointRows(const std::vector<std::array<double, 2>>& points) {
  std::vector<std::vector<double>> rows;
  for (const auto& [x, y] : points) rows.push_back({x, y});
  return rows;
}

/// Adds the data of a panel. @returns its plot command.
std::string AddPanel(const ResponsePanel& panel, std::size_t index, Figure& figure) {
  std::string pieces;
  for (std::size_t arm = 0; arm < panel.series.size(); ++arm) {
    const ResponseSeries& s = panel.series[arm];
    if (s.points.empty()) continue;
    const std::string id = fmt::format("r{}_{}", index, arm);
    figure.Data(id + "p", PointRows(s.points));
    figure.Data(id + "m", PointRows(s.means));
    pieces += fmt::format(
        "{}${}p u 1:2 w p pt {} ps 0.3 lc rgb '{}' notitle, ${}m u 1:2 w lp pt {} ps 0.6 lw 2 lc "
        "rgb '{}' t '{}'",
        pieces.empty() ? "" : ", ", id, static_cast<int>(Symbol::kDisc), StyleOfArm(arm).colour, id,
        static_cast<int>(Symbol::kSquare), StyleOfArm(arm).colour, Escape(s.arm));
  }
  return fmt::format("set xlabel '{}'; {} logscale x; plot {}", Escape(panel.x_label),
                     panel.log ? "set" : "unset", pieces);
}

}  // namespace

Figure DrawResponses(const ResponsePlot& plot) {
  constexpr int kPanelWidth_px = 330, kHeight_px = 420;
  Figure figure(plot.name, plot.title, kPanelWidth_px * static_cast<int>(plot.panels.size()),
                kHeight_px);
  std::vector<std::string> commands;
  for (std::size_t i = 0; i < plot.panels.size(); ++i)
    commands.push_back(AddPanel(plot.panels[i], i, figure));
  figure.Line(
      fmt::format("set multiplot layout 1,{} title '{}'", plot.panels.size(), Escape(plot.title)));
  figure.Line(
      fmt::format("set key top right; set ylabel '{}'; set format x '%g'", Escape(plot.y_label)));
  for (const std::string& command : commands) figure.Line(command);
  figure.Line("unset multiplot");
  return figure;
}

}  // namespace scoria::analysis
