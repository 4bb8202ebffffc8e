// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "analysis/study/results.h"

namespace scoria::analysis {

/// An episode of the arm adapted its model.
[[nodiscard]] bool Adapts(const CampaignResults& results, const std::string& arm);
[[nodiscard]] bool AnyAdapts(const CampaignResults& results);

}  // namespace scoria::analysis
