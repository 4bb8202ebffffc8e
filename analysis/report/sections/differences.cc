// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/statistics/power.h"
#include "analysis/study/verdicts.h"

namespace scoria::analysis {
namespace {

std::string DifferenceText(const MetricDifference& d) {
  return FormatDifference(d.pairs.difference, d.metric.scale, d.metric.digits);
}

std::string BootstrapText(const MetricDifference& d) {
  if (!d.pairs.bootstrap) return "–";
  const double scale = d.metric.scale;
  return fmt::format("{:+.{}f} to {:+.{}f}", scale * d.pairs.bootstrap->low, d.metric.digits,
                     scale * d.pairs.bootstrap->high, d.metric.digits);
}

/// In the unit shown.
std::string SeenText(const MetricDifference& d, const TestGoal& goal) {
  const double seen = DetectableEffect(static_cast<long>(d.pairs.difference.count), goal) *
                      d.pairs.difference.deviation;
  return NumberText(d.metric.scale * seen, d.metric.digits);
}

std::string ValueText(const MetricDifference& d, double p) {
  const bool tested = d.metric.better != Better::kNeither && d.pairs.difference.count > 1;
  return tested ? PValueText(p) : "–";
}

std::string JudgementText(const MetricDifference& d) {
  switch (Judge(d)) {
    case Judgement::kBetter:
      return "better";
    case Judgement::kWorse:
      return "worse";
    case Judgement::kNoneShown:
      return "no evidence";
    case Judgement::kNoDirection:
      break;
  }
  return "–";
}

std::string BetterText(const MetricDifference& d) {
  if (d.metric.better == Better::kNeither) return "neither";
  return d.metric.better == Better::kLower ? "lower" : "higher";
}

using D = MetricDifference;
constexpr std::array<Column<D>, 13> kDifferenceColumns = {{
    {"metric", [](const D& d) { return TitleWithUnit(d.metric); }},
    {"seeds", [](const D& d) { return std::to_string(d.pairs.difference.count); }},
    {"arm", [](const D& d) { return ShownNumber(d.metric, d.pairs.mean_a); }},
    {"first arm", [](const D& d) { return ShownNumber(d.metric, d.pairs.mean_b); }},
    {"difference", DifferenceText},
    {"better is", BetterText},
    {"the arm is", JudgementText},
    {"bootstrap, 95 %", BootstrapText},
    {"effect size", [](const D& d) { return NumberText(d.pairs.effect_size, 2); }},
    {"correlation of the pairs", [](const D& d) { return NumberText(d.pairs.correlation, 2); }},
    {"p", [](const D& d) { return ValueText(d, d.pairs.p_value); }},
    {"p, Holm", [](const D& d) { return ValueText(d, d.holm); }},
    {"false discovery rate", [](const D& d) { return ValueText(d, d.false_discovery); }},
}};

/// With what the seeds could see.
Table DifferenceTable(const ArmDifferences& d, const TestGoal& goal) {
  Table table = TableOf(d.metrics, kDifferenceColumns);
  table.header.emplace_back("difference that the seeds see");
  for (std::size_t i = 0; i < d.metrics.size(); ++i)
    table.rows[i].push_back(SeenText(d.metrics[i], goal));
  return table;
}

/// Over the whole sweep.
std::vector<ArmDifferences> PooledDifferences(const ReportInput& input) {
  std::vector<ArmDifferences> pooled = input.differences;
  std::erase_if(pooled,
                [](const ArmDifferences& d) { return !d.point.empty() || d.metrics.empty(); });
  return pooled;
}

std::optional<std::string> WhyNoDifferences(const ReportInput& input) {
  if (input.results.arms.size() < 2) return "there is one arm, and none to compare it with";
  if (PooledDifferences(input).empty()) return "no seed was walked by two arms";
  return std::nullopt;
}

Blocks BuildDifferences(const ReportInput& input) {
  Blocks blocks;
  for (const ArmDifferences& d : PooledDifferences(input)) {
    blocks.push_back(Heading{fmt::format("{} against {}", d.arm, d.baseline)});
    if (const std::string verdict = MetricVerdict(d); !verdict.empty())
      blocks.push_back(Paragraph{verdict});
    blocks.push_back(DifferenceTable(d, input.goal));
  }
  blocks.push_back(Note{fmt::format(
      "Episodes of the same seed and point in pairs; those that one of the arms did not walk "
      "are left out. Means over seeds of the seeds' means over the sweep, and of the "
      "differences, arm minus first arm, with Student's interval, and by resampling seeds. "
      "Better and worse: Holm's p-value is at most 5 %, so that with 95 % none of these words is "
      "wrong. Intervals are of each metric by itself: about one in twenty misses the truth by "
      "chance. Of the rejections with a false discovery rate below 5 % one in twenty is wrong. "
      "Effect "
      "size: mean over standard deviation of the differences. Correlation: what the pairing "
      "gains; with none, unpaired seeds would do as well. Last column: the smallest difference "
      "that so many seeds see (power {:.0f} %, level {:g} %). Falls are compared by their "
      "rates, above.",
      100.0 * input.goal.power, 100.0 * input.goal.alpha)});
  return blocks;
}

}  // namespace

Section DifferencesSection() {
  return {"differences", "Differences between the arms", WhyNoDifferences, BuildDifferences};
}

}  // namespace scoria::analysis
