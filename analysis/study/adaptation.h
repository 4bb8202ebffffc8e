// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/study/metric_differences.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// An episode of the arm adapted its model.
[[nodiscard]] bool Adapts(const CampaignResults& results, const std::string& arm);
[[nodiscard]] bool AnyAdapts(const CampaignResults& results);

/// Every other arm against the first that walked without adaptation, over the whole sweep and at
/// each of its points, where pairs of them tracked a height. None where all or no arms adapt.
[[nodiscard]] std::vector<ArmDifferences> CompareWithUnadapted(const CampaignResults& results,
                                                               const Metrics& metrics);

}  // namespace scoria::analysis
