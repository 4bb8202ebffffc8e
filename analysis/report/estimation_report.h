// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "analysis/plots/figures.h"
#include "analysis/report/html.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {

/// Section "State estimation": drift, relative errors and consistency per arm and point; nothing
/// where every episode walked on the truth.
void AddStateEstimation(const CampaignResults& results, const std::vector<Cell>& cells,
                        HtmlPage& page);

/// Section "Contact detection": every source against the truth, and whose word counted; nothing
/// where only the truth was heard.
void AddContactDetection(const CampaignResults& results, const std::vector<Cell>& cells,
                         HtmlPage& page);

/// Receiver operating characteristics of sensor and observer, per arm; none without evidence.
[[nodiscard]] std::vector<CaptionedFigure> ContactFigures(const CampaignResults& results);

}  // namespace scoria::analysis
