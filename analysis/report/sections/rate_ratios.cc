// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

using C = Comparison;

std::string RangeText(const Interval& i) {
  return fmt::format("{} to {}", NumberText(i.low, 2), NumberText(i.high, 2));
}

constexpr std::array<Column<C>, 13> kRatioColumns = {{
    {"arms", [](const C& c) { return fmt::format("{} : {}", c.a, c.b); }},
    {"falls", [](const C& c) { return CountText(c.falls_a) + ", " + CountText(c.falls_b); }},
    {"ratio", [](const C& c) { return NumberText(c.rates.judged.ratio, 2); }},
    {"exact, 95 %", [](const C& c) { return RangeText(c.rates.exact.interval); }},
    {"terrains", [](const C& c) { return std::to_string(c.terrains); }},
    {"dispersion", [](const C& c) { return NumberText(c.rates.dispersion.index, 2); }},
    {"p of no dispersion", [](const C& c) { return PValueText(c.rates.dispersion.p_value); }},
    {"by terrain, 95 %", [](const C& c) { return RangeText(c.rates.by_terrain.interval); }},
    {"judged by",
     [](const C& c) { return std::string(c.rates.over_dispersed ? "terrain" : "exact"); }},
    {"p", [](const C& c) { return PValueText(c.rates.judged.p_value); }},
    {"p, Holm", [](const C& c) { return PValueText(c.holm); }},
    {"false discovery rate", [](const C& c) { return PValueText(c.false_discovery); }},
    {"p at any time", [](const C& c) { return PValueText(c.p_any_time); }},
}};

/// What the budget sees of an arm pair, and what it would take to see more.
std::vector<std::string> PowerRow(const C& c, const TestGoal& goal) {
  std::vector<std::string> row = {NumberText(c.detectable, 2)};
  const double dispersion = c.rates.over_dispersed ? c.rates.dispersion.index : 1.0;
  for (const double ratio : {1.5, 2.0, 3.0})
    row.push_back(NumberText(ExposureForRatio(LowerRate(c), ratio, goal, dispersion), 0));
  return row;
}

Table PowerTable(const ReportInput& input) {
  Table table{{"at", "arms", "metres of each arm", "ratio that they see", "metres for 1.5",
               "metres for 2", "metres for 3"},
              {}};
  for (const C& c : input.comparisons) {
    if (!c.point.empty()) continue;
    table.rows.push_back({PointName(input.results.axes, c.point), fmt::format("{} : {}", c.a, c.b),
                          NumberText(std::min(c.falls_a.exposure, c.falls_b.exposure), 0)});
    for (std::string& text : PowerRow(c, input.goal)) table.rows.back().push_back(std::move(text));
  }
  return table;
}

std::optional<std::string> WhyNoRateRatios(const ReportInput& input) {
  if (input.results.arms.size() < 2) return "there is one arm, and none to compare it with";
  for (const C& c : input.comparisons) {
    if (c.falls_a.events + c.falls_b.events > 0) return std::nullopt;
  }
  return "nobody fell whose falls could be compared";
}

Blocks BuildRateRatios(const ReportInput& input) {
  Table table = TableOf(input.comparisons, kRatioColumns);
  table.header.insert(table.header.begin(), "at");
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    table.rows[i].insert(table.rows[i].begin(),
                         PointName(input.results.axes, input.comparisons[i].point));
  return {
      table,
      Note{"Exact: conditional binomial, falls Poisson given the terrain. Dispersion: chi-squared "
           "over degrees of freedom of one arm's share of the falls, across terrains; above 1, "
           "terrains treat the arms differently. By terrain: bootstrap over terrain seeds. Holm "
           "and false discovery rate correct for the lines at points, and for those over the whole "
           "sweep, apart. The other p-values hold for a look at the end of the campaign as it was "
           "planned; p at any time also for who looks after every seed and stops when he likes "
           "(sequential sign test over terrains)."},
      PowerTable(input),
      Note{fmt::format(
          "Power {:.0f} %, level {:g} %, at the lower of the two rates measured, with as much "
          "dispersion as was found. Metres of each arm that it takes to see rates that differ by "
          "a factor of 1.5, 2 and 3.",
          100.0 * input.goal.power, 100.0 * input.goal.alpha)}};
}

}  // namespace

Section RateRatiosSection() {
  return {"rate_ratios", "Rate ratios and power", WhyNoRateRatios, BuildRateRatios};
}

}  // namespace scoria::analysis
