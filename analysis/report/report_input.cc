// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/report_input.h"

#include <algorithm>
#include <utility>

namespace scoria::analysis {

bool ReportInput::HasMetrics() const {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [](const EpisodeRecord& e) { return e.has_metrics; });
}

ReportInput MakeReportInput(const std::filesystem::path& folder, CampaignResults results,
                            std::optional<ReportPicture> picture) {
  ReportInput input;
  input.folder = folder;
  input.cells = AllCells(results);
  for (const std::string& arm : results.arms) input.pooled.push_back(PoolCell(results, arm, {}));
  if (results.arms.size() > 1) input.comparisons = AllComparisons(results);
  input.picture = std::move(picture);
  input.results = std::move(results);
  return input;
}

}  // namespace scoria::analysis
