// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <fmt/format.h>

#include "analysis/plots/survival_plot.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/lifetimes.h"

namespace scoria::analysis {
namespace {

SurvivalCurve CurveOf(const ReportInput& input, const std::string& arm) {
  return EstimateSurvival(LifetimesOf(input.results, arm, {}));
}

std::string MedianText(const SurvivalCurve& curve) {
  const auto median = curve.Median();
  return median ? fmt::format("{:.1f}", *median) : fmt::format("> {:.1f}", curve.end);
}

Table MedianTable(const std::vector<SurvivalSeries>& series) {
  Table table{{"arm", "episodes", "fell", "median metres to the first fall"}, {}};
  for (const SurvivalSeries& s : series) {
    long fell = 0;
    for (const SurvivalStep& step : s.curve.steps) fell += step.events;
    const long episodes = fell + static_cast<long>(s.curve.censored.size());
    table.rows.push_back({s.arm, std::to_string(episodes), std::to_string(fell),
                          episodes > 0 ? MedianText(s.curve) : "–"});
  }
  return table;
}

/// "a walks farther than b before its first fall" or no evidence.
std::string Verdict(const Comparison& c) {
  constexpr double kLevel = 0.05;
  const LogRank& r = c.log_rank;
  const std::string test =
      fmt::format("{:.0f} first falls where {:.1f} were expected, log-rank p {}{}", r.observed_a,
                  r.expected_a, r.p_value < 1e-4 ? "" : "= ", PValueText(r.p_value));
  if (r.p_value > kLevel)
    return fmt::format("No evidence that {} and {} walk differently far before the first fall: {}.",
                       c.a, c.b, test);
  return fmt::format("{} walks {} than {} before the first fall: {}.", c.a,
                     r.observed_a < r.expected_a ? "farther" : "less far", c.b, test);
}

std::optional<std::string> WhyNoSurvival(const ReportInput& input) {
  bool counted = false;
  for (const std::string& arm : input.results.arms) {
    const std::vector<Lifetime> lifetimes = LifetimesOf(input.results, arm, {});
    counted = counted || !lifetimes.empty();
    if (std::any_of(lifetimes.begin(), lifetimes.end(), [](const Lifetime& l) { return l.event; }))
      return std::nullopt;
  }
  return counted ? "no episode fell whose way to the first fall is known"
                 : "nobody counted falls and the way to the first one";
}

Blocks BuildSurvival(const ReportInput& input) {
  SurvivalPlot plot{"survival",
                    "Metres to the first fall",
                    "metres walked",
                    "share of the episodes that have not fallen",
                    {}};
  for (const std::string& arm : input.results.arms)
    plot.series.push_back({arm, CurveOf(input, arm)});
  BulletList verdicts;
  for (const Comparison& c : input.comparisons) {
    if (c.point.empty()) verdicts.items.push_back(Verdict(c));
  }
  Blocks blocks;
  if (!verdicts.items.empty()) blocks.push_back(verdicts);
  blocks.push_back(CaptionedFigure{
      DrawSurvival(plot),
      "Kaplan-Meier estimate over the whole sweep, with its pointwise 95 % band. Crosses: episodes "
      "that ended without a fall; they count as walked so far."});
  blocks.push_back(MedianTable(plot.series));
  blocks.push_back(
      Note{"The log-rank test is stratified by terrain: arms are compared at equal seed and point "
           "of the sweep."});
  return blocks;
}

}  // namespace

Section SurvivalSection() {
  return {"survival", "Metres to the first fall", WhyNoSurvival, BuildSurvival};
}

}  // namespace scoria::analysis
