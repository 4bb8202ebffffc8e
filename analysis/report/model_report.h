// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/plots/figures.h"
#include "analysis/report/html.h"
#include "analysis/study/compare.h"
#include "logs/read_rows.h"

namespace scoria::analysis {

/// Section "Online model adaptation": what was learned of the mass per arm, point and interval of
/// the true mass; nothing where no arm adapted.
void AddModelAdaptation(const CampaignResults& results, const std::vector<Cell>& cells,
                        HtmlPage& page);

/// Course of learned, used and true mass and centre of mass: of the first episode of each adapting
/// arm that kept its log.
[[nodiscard]] std::vector<CaptionedFigure> ModelFigures(const CampaignResults& results);
[[nodiscard]] CaptionedFigure ModelFigure(const logs::LogContent& log, const std::string& name);

/// One arm's tracking against the one without adaptation, on the same seeds.
struct TrackingDifference {
  std::string arm, baseline;
  std::vector<std::string> point;  // empty: all
  // Means over the seeds that both walked, of the seeds' mean RMSE over the sweep.
  double height_m = 0.0, roll_rad = 0.0, pitch_rad = 0.0;
  double baseline_height_m = 0.0, baseline_roll_rad = 0.0, baseline_pitch_rad = 0.0;
  MeanEstimate height_difference_m, roll_difference_rad, pitch_difference_rad;  // arm - baseline
};
/// Every other arm against the first without adaptation; none where all or no arms adapt.
[[nodiscard]] std::vector<TrackingDifference> CompareTracking(const CampaignResults& results);

/// Section "Tracking with and without adaptation".
void AddAdaptedTracking(const CampaignResults& results, HtmlPage& page);

}  // namespace scoria::analysis
