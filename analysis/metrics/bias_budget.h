// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/mean.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// How an arm's learned model is off at a point of the sweep, over seeds. Learned minus true, of
/// the intervals after a change of mass, from kLate_s after it on. Definitions: docs/METRICS.md.
struct BiasLine {
  std::string arm;
  std::vector<std::string> point;
  MeanEstimate bias_kg;               // of the seeds' means over their intervals
  MeanEstimate added_kg, removed_kg;  // after steps up and after steps down
  MeanEstimate noise_kg;              // standard deviation within an interval
  MeanEstimate com_x_m, com_y_m;
  bool baseline = false;
  MeanEstimate change_kg;  // of the bias against the baseline's, by seed; none of the baseline
};

/// One line per arm and point of a campaign one of whose axes names its baseline; else none. Points
/// that differ from it on that axis alone are compared with it.
[[nodiscard]] std::vector<BiasLine> CalcBiasBudget(const CampaignResults& results);

}  // namespace scoria::analysis
