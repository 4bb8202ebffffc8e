// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "analysis/statistics/stats.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// One arm at one point of the sweep, pooled over seeds.
struct Cell {
  std::string arm;
  std::vector<std::string> point;
  int episodes = 0, broken = 0;  // broken: crashed, missing or not finite
  int stuck = 0;
  RateEstimate falls;  // per metre
  double cot_mech_abs = 0.0, cot_mech_pos = 0.0, cot_electrical = 0.0,
         cot_battery = 0.0;          // pooled: energy over m g d
  EnergyBudget budget;               // summed
  TrackingErrors tracking;           // root of the mean squares, weighted by time
  EstimationMetrics estimation;      // added up
  std::vector<ModelMetrics> models;  // by episode
  double mpc_median_s = 0.0, mpc_p99_s = 0.0, wbc_median_s = 0.0,
         wbc_p99_s = 0.0;  // mean median, worst p99
  double real_time_factor = 0.0;
};

/// @param point empty pools the whole sweep.
[[nodiscard]] Cell PoolCell(const CampaignResults& results, const std::string& arm,
                            const std::vector<std::string>& point);

/// Falls of arm `a` against arm `b` at one point (or over all), with the honest doubts.
struct Comparison {
  std::string a, b;
  std::vector<std::string> point;
  Cell cell_a, cell_b;
  RatioEstimate ratio;       // of falls per metre, a over b
  std::size_t terrains = 0;  // walked by both
  Dispersion dispersion;     // across terrains, of a's share of the falls
  Interval bootstrap;        // of the ratio, by terrain
  double detectable = 0.0;   // smallest ratio that this budget could see
  std::string places;        // in how many groups the falls of both lie (DescribeGroups)
  std::string verdict;       // one sentence
};
[[nodiscard]] Comparison Compare(const CampaignResults& results, const std::string& a,
                                 const std::string& b, const std::vector<std::string>& point);

/// Grounds that arms walked at a point (empty: over the whole sweep).
[[nodiscard]] std::size_t CountGrounds(const CampaignResults& results,
                                       const std::vector<std::string>& arms,
                                       const std::vector<std::string>& point);

/// "speed 0.3, roughness 1" or "all".
[[nodiscard]] std::string PointName(const std::vector<Axis>& axes,
                                    const std::vector<std::string>& point);

/// "133.5 m (95 %: 37 to 1102 m)", or "> 49 m (no fall in 180 m)".
[[nodiscard]] std::string MetresPerFall(const RateEstimate& falls);

/// "-0.52 (95 %: -0.61 to -0.43)", the mean alone for a single value, a dash for none.
/// @param scale to the unit shown.
[[nodiscard]] std::string FormatDifference(const MeanEstimate& e, double scale, int digits);

/// Every arm at every point of the sweep.
[[nodiscard]] std::vector<Cell> AllCells(const CampaignResults& results);

/// Every arm against the first, over the whole sweep and at each of its points.
[[nodiscard]] std::vector<Comparison> AllComparisons(const CampaignResults& results);

}  // namespace scoria::analysis
