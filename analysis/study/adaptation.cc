// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/adaptation.h"

#include <algorithm>

#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

bool Walked(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.has_metrics; });
}

}  // namespace

bool Adapts(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.metrics.model.present; });
}

bool AnyAdapts(const CampaignResults& results) {
  return std::any_of(results.arms.begin(), results.arms.end(),
                     [&](const auto& arm) { return Adapts(results, arm); });
}

std::vector<ArmDifferences> CompareWithUnadapted(const CampaignResults& results,
                                                 const Metrics& metrics) {
  std::vector<ArmDifferences> all;
  const auto baseline =
      std::find_if(results.arms.begin(), results.arms.end(),
                   [&](const auto& arm) { return Walked(results, arm) && !Adapts(results, arm); });
  if (!AnyAdapts(results) || baseline == results.arms.end()) return all;
  const MetricComparer comparer(results, metrics);
  for (const auto& point : SweepAndPoints(results.axes)) {
    for (const std::string& arm : results.arms) {
      if (arm == *baseline) continue;
      ArmDifferences d = comparer.Compare(arm, *baseline, point);
      if (d.Find("height_rmse_m") != nullptr) all.push_back(std::move(d));
    }
  }
  return all;
}

}  // namespace scoria::analysis
