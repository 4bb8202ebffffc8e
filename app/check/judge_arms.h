// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "app/campaign/campaign.h"
#include "app/check/judge.h"

namespace scoria::app {

/// Judges a campaign by what it expects of its arms: values pooled over the episodes of an arm, and
/// arms against each other. Rates of falls by the exact conditional ratio, metrics by Student's
/// interval of the differences between pairs of the same seed.
[[nodiscard]] std::vector<Finding> JudgeArms(const ArmExpectations& expected,
                                             const analysis::CampaignResults& results);

}  // namespace scoria::app
