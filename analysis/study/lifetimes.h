// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/log_rank.h"
#include "analysis/statistics/survival.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// Metres to the first fall of every episode of an arm at a point (empty: over the whole sweep);
/// those that did not fall are censored where they ended. Episodes that nobody counted falls of, or
/// that fell, and older results do not say where, are left out.
[[nodiscard]] std::vector<Lifetime> LifetimesOf(const CampaignResults& results,
                                                const std::string& arm,
                                                const std::vector<std::string>& point);

/// Log-rank test of two arms, stratified by terrain: episodes of one seed at one point.
[[nodiscard]] LogRank CompareLifetimes(const CampaignResults& results, const std::string& a,
                                       const std::string& b, const std::vector<std::string>& point);

}  // namespace scoria::analysis
