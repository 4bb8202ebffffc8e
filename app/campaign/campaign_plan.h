// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>

#include "analysis/report/document.h"
#include "analysis/statistics/power.h"
#include "analysis/study/results.h"
#include "app/campaign/campaign.h"

namespace scoria::app {

/// What is assumed of how often arms fall.
struct FallRate {
  double per_m = 0.0;
  std::string source;  // in words
};

/// The rate over all arms of results; nothing where nobody fell.
[[nodiscard]] std::optional<FallRate> MeasuredFallRate(const analysis::CampaignResults& results);

/// Before a campaign runs: episodes and metres, the smallest rate ratio of falls that they will
/// see, metres and seeds that it takes for others, and the effect on a metric that the seeds will
/// see.
/// @param rate  of the arm that falls less; without one, one fall in 30, 100 and 300 m are tried.
[[nodiscard]] analysis::Document PlanCampaign(const Campaign& campaign,
                                              const analysis::TestGoal& goal,
                                              const std::optional<FallRate>& rate);

}  // namespace scoria::app
