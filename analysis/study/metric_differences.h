// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/paired_difference.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// A metric of an arm against that of a baseline, in pairs of the same seed and point.
struct MetricDifference {
  MetricInfo metric;
  /// Arm (a) minus baseline (b) over the seeds that have pairs, of the seeds' means over the sweep.
  PairedDifference pairs;
  /// p-values adjusted for the metrics of the comparison that have a better direction; 1 of others.
  double holm = 1.0, false_discovery = 1.0;
};

/// What a difference says among the others of its comparison: Holm's p-value is at most 5 %, or
/// not.
enum class Judgement { kBetter, kWorse, kNoneShown, kNoDirection };
[[nodiscard]] Judgement Judge(const MetricDifference& d) noexcept;

/// An arm against a baseline at a point of the sweep (empty: all of it): the metrics that pairs of
/// both have.
struct ArmDifferences {
  std::string arm, baseline;
  std::vector<std::string> point;
  std::vector<MetricDifference> metrics;
  /// @returns null where no pair has it.
  [[nodiscard]] const MetricDifference* Find(std::string_view key) const noexcept;
};

/// Differences of a campaign's episodes. Borrows both arguments.
class MetricComparer {
 public:
  MetricComparer(const CampaignResults& results, const Metrics& metrics);
  [[nodiscard]] ArmDifferences Compare(const std::string& arm, const std::string& baseline,
                                       const std::vector<std::string>& point) const;

 private:
  const CampaignResults& results_;
  const Metrics& metrics_;
  std::vector<MetricValues> values_;  // of each episode; none of those without numbers
};

/// Every other arm against the first, over the whole sweep and at each of its points.
[[nodiscard]] std::vector<ArmDifferences> AllDifferences(const CampaignResults& results,
                                                         const Metrics& metrics);

}  // namespace scoria::analysis
