// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/study/adaptation.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

constexpr std::array<std::string_view, 3> kShown = {"height_rmse_m", "roll_rmse_rad",
                                                    "pitch_rmse_rad"};

std::optional<std::string> WhyNoAdaptedTracking(const ReportInput& input) {
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kTrueMass}))) return reason;
  if (!AnyAdapts(input.results)) return "no arm adapted its model";
  const auto& arms = input.results.arms;
  if (std::all_of(arms.begin(), arms.end(),
                  [&](const auto& a) { return Adapts(input.results, a); }))
    return "every arm adapted its model";
  if (!CompareWithUnadapted(input.results, input.metrics).empty()) return std::nullopt;
  return "no seed was walked steadily both with and without adaptation";
}

/// What an arm's line says of one metric.
void AppendCells(const ArmDifferences& d, const MetricInfo& info, std::vector<std::string>& row) {
  const MetricDifference* found = d.Find(info.key);
  row.push_back(found == nullptr ? "–"
                                 : fmt::format("{} / {}", ShownNumber(info, found->pairs.mean_a),
                                               ShownNumber(info, found->pairs.mean_b)));
  row.push_back(
      found == nullptr ? "–" : FormatDifference(found->pairs.difference, info.scale, info.digits));
}

Blocks BuildAdaptedTracking(const ReportInput& input) {
  const auto all = CompareWithUnadapted(input.results, input.metrics);
  Table table{{"at", "arms", "seeds"}, {}};
  for (const ArmDifferences& d : all) {
    const MetricDifference* height = d.Find(kShown.front());
    table.rows.push_back({PointName(input.results.axes, d.point),
                          fmt::format("{} against {}", d.arm, d.baseline),
                          std::to_string(height->pairs.difference.count)});
  }
  for (const std::string_view key : kShown) {
    const Metric* metric = FindMetric(input.metrics, key);
    if (metric == nullptr) continue;
    table.header.push_back(TitleWithUnit(metric->info));
    table.header.push_back(fmt::format("difference [{}]", ShownUnit(metric->info)));
    for (std::size_t i = 0; i < all.size(); ++i) AppendCells(all[i], metric->info, table.rows[i]);
  }
  return {table,
          Note{"Episodes of the same seed in pairs; those that one of the arms did not walk are "
               "left out. Means over the seeds of the episodes' RMSE over steady walking, with "
               "Student's interval of the mean difference; negative is better than without "
               "adaptation."}};
}

}  // namespace

Section AdaptedTrackingSection() {
  return {"adapted_tracking", "Tracking with and without adaptation", WhyNoAdaptedTracking,
          BuildAdaptedTracking};
}

}  // namespace scoria::analysis
