// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/stats.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

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

}  // namespace scoria::analysis
