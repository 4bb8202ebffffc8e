// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/sections/adaptation.h"

#include <algorithm>

namespace scoria::analysis {

bool Adapts(const CampaignResults& results, const std::string& arm) {
  return std::any_of(results.episodes.begin(), results.episodes.end(),
                     [&](const auto& e) { return e.arm == arm && e.metrics.model.present; });
}

bool AnyAdapts(const CampaignResults& results) {
  return std::any_of(results.arms.begin(), results.arms.end(),
                     [&](const auto& arm) { return Adapts(results, arm); });
}

}  // namespace scoria::analysis
