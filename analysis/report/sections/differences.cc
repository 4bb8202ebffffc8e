// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

std::string DifferenceText(const MetricDifference& d) {
  return FormatDifference(d.difference, d.metric.scale, d.metric.digits);
}

std::string JudgementText(const MetricDifference& d) {
  switch (Judge(d)) {
    case Judgement::kBetter:
      return "better";
    case Judgement::kWorse:
      return "worse";
    case Judgement::kNoneShown:
      return "no difference shown";
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
constexpr std::array<Column<D>, 7> kColumns = {{
    {"metric", [](const D& d) { return TitleWithUnit(d.metric); }},
    {"seeds", [](const D& d) { return std::to_string(d.difference.count); }},
    {"arm", [](const D& d) { return ShownNumber(d.metric, d.mean); }},
    {"first arm", [](const D& d) { return ShownNumber(d.metric, d.baseline_mean); }},
    {"difference", DifferenceText},
    {"better is", BetterText},
    {"the arm is", JudgementText},
}};

/// Over the whole sweep.
std::vector<ArmDifferences> Pooled(const ReportInput& input) {
  std::vector<ArmDifferences> pooled = input.differences;
  std::erase_if(pooled,
                [](const ArmDifferences& d) { return !d.point.empty() || d.metrics.empty(); });
  return pooled;
}

std::optional<std::string> WhyNot(const ReportInput& input) {
  if (input.results.arms.size() < 2) return "there is one arm, and none to compare it with";
  if (Pooled(input).empty()) return "no seed was walked by two arms";
  return std::nullopt;
}

Blocks Build(const ReportInput& input) {
  Blocks blocks;
  for (const ArmDifferences& d : Pooled(input)) {
    blocks.push_back(Heading{fmt::format("{} against {}", d.arm, d.baseline)});
    blocks.push_back(TableOf(d.metrics, kColumns));
  }
  blocks.push_back(
      Note{"Episodes of the same seed and point in pairs; those that one of the arms did not walk "
           "are left out. Means over seeds of the seeds' means over the sweep, and of the "
           "differences, arm minus first arm, with Student's interval. Better and worse: the "
           "interval lies on one side of zero. Intervals are not corrected for looking at many "
           "metrics: about one in twenty misses the truth by chance. Falls are compared by their "
           "rates, above."});
  return blocks;
}

}  // namespace

Section DifferencesSection() {
  return {"differences", "Differences between the arms", WhyNot, Build};
}

}  // namespace scoria::analysis
