// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/plots/course_plot.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "analysis/plots/gnuplot.h"

namespace scoria::analysis {
namespace {

bool HasValue(const std::vector<double>& values) {
  return std::ranges::any_of(values, [](double value) { return std::isfinite(value); });
}

/// What there is to draw.
CoursePlot WithValues(CoursePlot plot) {
  for (CoursePanel& panel : plot.panels) {
    std::erase_if(panel.lines, [](const CourseLine& line) { return !HasValue(line.y); });
    std::erase_if(panel.bands, [](const CourseBand& band) { return !HasValue(band.low); });
  }
  std::erase_if(plot.panels, [](const CoursePanel& panel) {
    return panel.lines.empty() && panel.bands.empty() && panel.states.empty();
  });
  return plot;
}

/// The columns of the data in the order in which the panels use them, after the time.
std::vector<double> RowAt(const CoursePlot& plot, std::size_t i) {
  std::vector<double> row = {plot.time_s[i]};
  for (const CoursePanel& panel : plot.panels) {
    for (const CourseBand& band : panel.bands) {
      row.push_back(band.low[i]);
      row.push_back(band.high[i]);
    }
    for (const CourseLine& line : panel.lines) row.push_back(line.y[i]);
    for (std::size_t k = 0; k < panel.states.size(); ++k)
      row.push_back(panel.states[k].holds[i] ? static_cast<double>(panel.states.size() - k) : kGap);
  }
  return row;
}

void AddData(const CoursePlot& plot, Figure& figure) {
  constexpr std::size_t kMostPoints = 4000;
  constexpr double kGap_s = 1.0;
  const std::size_t every = std::max<std::size_t>(1, plot.time_s.size() / kMostPoints);
  std::vector<std::vector<double>> rows;
  std::size_t gap = 0;
  for (std::size_t i = 0; i < plot.time_s.size(); i += every) {
    std::vector<double> row = RowAt(plot, i);
    bool breaks = !rows.empty() && plot.time_s[i] - rows.back()[0] > kGap_s;
    for (; gap < plot.gaps_s.size() && plot.time_s[i] >= plot.gaps_s[gap].second; ++gap)
      breaks = true;
    if (breaks) rows.emplace_back(row.size(), kGap);
    rows.push_back(std::move(row));
  }
  figure.Data("d", rows);
}

/// Marks and shaded stretches, on every panel. Shades alternate, so that neighbours are told apart.
void AddEvents(const CoursePlot& plot, Figure& figure) {
  for (std::size_t i = 0; i < plot.stretches_s.size(); ++i) {
    const auto& [start_s, end_s] = plot.stretches_s[i];
    figure.Line(fmt::format(
        "set object {} rect from {},graph 0 to {},graph 1 behind fs solid 1 noborder fc rgb '{}'",
        i + 1, start_s, end_s, i % 2 == 0 ? Palette::kLightGrey : Palette::kGrey));
  }
  for (std::size_t i = 0; i < plot.marks_s.size(); ++i) {
    figure.Line(fmt::format("set arrow {} from {},graph 0 to {},graph 1 nohead lc rgb '{}' dt 2",
                            i + 1, plot.marks_s[i], plot.marks_s[i], Palette::kVermilion));
  }
}

std::string StatePieces(const CoursePanel& panel, std::size_t& column) {
  std::string pieces, ticks;
  for (std::size_t k = 0; k < panel.states.size(); ++k) {
    ticks += fmt::format("{}'{}' {}", k > 0 ? ", " : "", Escape(panel.states[k].label),
                         panel.states.size() - k);
    pieces += fmt::format("{}$d u 1:{} w l lw 6 lc rgb '{}' notitle", k > 0 ? ", " : "", column++,
                          panel.state_colour);
  }
  return fmt::format("unset key; unset offsets; set yrange [0.5:{}.5]; set ytics ({}); plot {}",
                     panel.states.size(), ticks, pieces);
}

std::string LinePieces(const CoursePanel& panel, std::size_t& column) {
  std::string pieces;
  for (const CourseBand& band : panel.bands) {
    pieces += fmt::format(
        "{}$d u 1:{}:{} w filledcurves fs transparent solid 0.3 noborder lc rgb '{}' t '{}'",
        pieces.empty() ? "" : ", ", column, column + 1, band.colour, Escape(band.label));
    column += 2;
  }
  for (const CourseLine& line : panel.lines) {
    pieces +=
        fmt::format("{}$d u 1:{} w l lw 1.3 dt {} lc rgb '{}' t '{}'", pieces.empty() ? "" : ", ",
                    column++, line.dashed ? 2 : 1, line.colour, Escape(line.label));
  }
  return "set key top right horizontal; set offsets 0,0,graph 0.18,0; set yrange [*:*]; set ytics "
         "autofreq; plot " +
         pieces;
}

}  // namespace

Figure DrawCourse(const CoursePlot& wanted) {
  const CoursePlot plot = WithValues(wanted);
  const std::size_t n = plot.panels.size();
  const int height_px = 250 + 170 * static_cast<int>(n);
  Figure figure(plot.name, plot.title, 1000, height_px);
  AddData(plot, figure);
  AddEvents(plot, figure);
  if (!plot.time_s.empty())
    figure.Line(fmt::format("set xrange [{}:{}]", plot.time_s.front(), plot.time_s.back()));
  const auto share = [&](double px) { return px / height_px; };
  figure.Line(fmt::format(
      "set multiplot layout {},1 title '{}' margins 0.09,0.97,{:.4f},{:.4f} spacing 0,{:.4f}", n,
      Escape(plot.title), share(70.0), 1.0 - share(60.0), share(44.0)));
  figure.Line("set format x ''");
  std::size_t column = 2;
  for (std::size_t i = 0; i < n; ++i) {
    const CoursePanel& panel = plot.panels[i];
    if (i + 1 == n) figure.Line("set format x '%g'; set xlabel 'time [s]'");
    figure.Line(
        fmt::format("set ylabel '{}'; {}", Escape(panel.y_label),
                    panel.states.empty() ? LinePieces(panel, column) : StatePieces(panel, column)));
  }
  figure.Line("unset multiplot");
  return figure;
}

}  // namespace scoria::analysis
