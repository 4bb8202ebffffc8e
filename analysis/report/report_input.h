// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "analysis/report/document.h"
#include "analysis/study/compare.h"
#include "analysis/study/metric_differences.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// What the sections of a report are made from.
struct ReportInput {
  std::filesystem::path folder;  // of the campaign or run
  CampaignResults results;
  std::vector<Cell> cells;                  // every arm at every point of the sweep
  std::vector<Cell> pooled;                 // every arm over the whole sweep
  std::vector<Comparison> comparisons;      // none of a single arm
  std::vector<ArmDifferences> differences;  // likewise, in the same order
  Metrics metrics;                          // the registry
  std::optional<logs::RowGroups> groups;    // that some episode's rows had; unknown: older results
  Substitutes substitutes;                  // for groups that the logs of robots lack
  std::optional<ReportPicture> picture;
  TestGoal goal;  // of what the budget could see

  /// Some episode has numbers.
  [[nodiscard]] bool HasMetrics() const;
};

/// Pools and compares the results. Errors: none.
[[nodiscard]] ReportInput MakeReportInput(const std::filesystem::path& folder,
                                          CampaignResults results,
                                          std::optional<ReportPicture> picture,
                                          const Metrics& metrics = AllMetrics(),
                                          const TestGoal& goal = {});

}  // namespace scoria::analysis
