// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/report_input.h"

#include <algorithm>
#include <utility>

namespace scoria::analysis {

bool ReportInput::HasMetrics() const {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [](const EpisodeRecord& e) { return e.has_metrics; });
}

namespace {

/// That the rows of some episode had; nothing where an episode does not say.
std::optional<logs::RowGroups> GroupsOf(const CampaignResults& results) {
  logs::RowGroups groups;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics) continue;
    if (!e.metrics.groups) return std::nullopt;
    groups |= *e.metrics.groups;
  }
  return groups.any() ? std::optional(groups) : std::nullopt;
}

Substitutes SubstitutesOf(const CampaignResults& results) {
  Substitutes all;
  for (const EpisodeRecord& e : results.episodes)
    all.insert(e.metrics.substitutes.begin(), e.metrics.substitutes.end());
  return all;
}

}  // namespace

ReportInput MakeReportInput(const std::filesystem::path& folder, CampaignResults results,
                            std::optional<ReportPicture> picture, const Metrics& metrics,
                            const TestGoal& goal) {
  ReportInput input;
  input.goal = goal;
  input.folder = folder;
  input.metrics = metrics;
  input.groups = GroupsOf(results);
  input.substitutes = SubstitutesOf(results);
  input.cells = AllCells(results, metrics);
  for (const std::string& arm : results.arms)
    input.pooled.push_back(PoolCell(results, arm, {}, metrics));
  if (results.arms.size() > 1) {
    input.comparisons = AllComparisons(results, goal);
    input.differences = AllDifferences(results, metrics);
  }
  input.picture = std::move(picture);
  input.results = std::move(results);
  return input;
}

}  // namespace scoria::analysis
