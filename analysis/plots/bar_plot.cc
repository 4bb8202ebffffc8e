// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/bar_plot.h"

#include <fmt/format.h>

#include "analysis/plots/style.h"

namespace scoria::analysis {
namespace {

/// Adds the data of a panel. @returns its plot command.
std::string AddPanel(const BarPlot& plot, std::size_t index, Figure& figure) {
  constexpr double kWidth = 0.7;  // of all bars of an arm, whose ticks are 1 apart
  const BarPanel& panel = plot.panels[index];
  const std::string block = fmt::format("p{}", index);
  std::vector<std::vector<double>> rows;
  for (std::size_t a = 0; a < plot.arms.size(); ++a) {
    std::vector<double>& row = rows.emplace_back(1, static_cast<double>(a));
    for (const Bars& bars : panel.bars) row.push_back(bars.values[a]);
  }
  figure.Data(block, rows);
  const auto count = static_cast<double>(panel.bars.size());
  std::string command = fmt::format("set title '{}'; set boxwidth {:.3f}; plot ",
                                    Escape(panel.title), kWidth / count);
  for (std::size_t k = 0; k < panel.bars.size(); ++k) {
    const double shift = kWidth / count * (static_cast<double>(k) - 0.5 * (count - 1.0));
    command += fmt::format("{}${} u ($1{:+.3f}):{} w boxes lc rgb '{}' t '{}'", k > 0 ? ", " : "",
                           block, shift, k + 2, PaletteColour(k), Escape(panel.bars[k].label));
  }
  return command;
}

}  // namespace

Figure DrawBars(const BarPlot& plot) {
  Figure figure(plot.name, plot.title, 900, 420);
  std::vector<std::string> commands;
  bool has_key = false;
  for (std::size_t i = 0; i < plot.panels.size(); ++i) {
    commands.push_back(AddPanel(plot, i, figure));
    has_key = has_key || plot.panels[i].bars.size() > 1;
  }
  figure.Line(fmt::format("set multiplot layout 1,{} title '{}'; set style fill solid 0.8",
                          plot.panels.size(), Escape(plot.title)));
  figure.Line(has_key ? "set key top center horizontal; set offsets 0, 0, graph 0.15, 0"
                      : "unset key");
  constexpr std::size_t kWidePanels = 2;  // names of arms fit below them
  figure.Line(fmt::format("set xtics ({}){}; set yrange [0:*]; set xrange [-0.6:{}]",
                          ArmTicks(plot.arms),
                          plot.panels.size() > kWidePanels ? " rotate by -30" : "",
                          static_cast<double>(plot.arms.size()) - 0.4));
  for (const std::string& command : commands) figure.Line(command);
  figure.Line("unset multiplot");
  return figure;
}

}  // namespace scoria::analysis
