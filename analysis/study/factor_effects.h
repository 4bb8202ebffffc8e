// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/sobol_indices.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// How a metric of an arm answers to the factors of a design.
struct FactorEffects {
  std::string arm;
  MetricInfo metric;
  std::vector<std::optional<double>> responses;  // by point: mean over its seeds
  std::size_t rows = 0;                          // of points that are whole
  std::vector<SobolIndices> indices;             // by factor; from the whole rows
};

/// Of every metric with a better direction, for one arm; those that no episode has are left out.
/// None of a campaign without a design.
[[nodiscard]] std::vector<FactorEffects> CalcFactorEffects(const CampaignResults& results,
                                                           const std::string& arm,
                                                           const Metrics& metrics);

/// Means of responses in bins of equally many points along one factor.
/// @returns pairs (mean value of the factor, mean response), by rising value.
[[nodiscard]] std::vector<std::array<double, 2>> BinnedResponse(
    std::vector<std::array<double, 2>> points);

}  // namespace scoria::analysis
