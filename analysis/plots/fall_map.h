// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/plots/figures.h"

namespace scoria::analysis {

/// Shaded relief, route and falls by arm, for the grounds with the most falls (the first four). The
/// ground is made again from its episode's scenario.yaml; a ground that cannot be made is left out.
[[nodiscard]] std::vector<CaptionedFigure> FallMaps(const CampaignResults& results);

}  // namespace scoria::analysis
