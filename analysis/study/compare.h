// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/registry.h"
#include "analysis/statistics/log_rank.h"
#include "analysis/statistics/mean.h"
#include "analysis/statistics/power.h"
#include "analysis/statistics/rate_comparison.h"
#include "analysis/study/results.h"

namespace scoria::analysis {

/// One arm at one point of the sweep, pooled over seeds.
struct Cell {
  std::string arm;
  std::vector<std::string> point;
  int episodes = 0, broken = 0;       // broken: crashed, missing or not finite
  RateEstimate falls;                 // per metre
  std::optional<EpisodeMetrics> sum;  // of the episodes that left numbers
  std::vector<ModelMetrics> models;   // by episode
  MetricValues values;                // of the registry, each pooled as its metric says
};

/// @param point empty pools the whole sweep.
[[nodiscard]] Cell PoolCell(const CampaignResults& results, const std::string& arm,
                            const std::vector<std::string>& point,
                            const Metrics& metrics = AllMetrics());

/// Falls of arm `a` against arm `b` at one point (or over all), with their uncertainty.
struct Comparison {
  std::string a, b;
  std::vector<std::string> point;
  RateEstimate falls_a, falls_b;  // per metre
  RateComparison rates;           // of falls per metre, a over b
  std::size_t terrains = 0;       // walked by both
  /// p-values adjusted for the comparisons of the same kind: those over the whole sweep, or those
  /// at its points.
  double holm = 1.0, false_discovery = 1.0;
  /// Valid whenever one looks: SequentialSignTest over the terrains, by rising seed.
  double p_any_time = 1.0;
  LogRank log_rank;         // of the metres to the first fall
  double detectable = 0.0;  // smallest ratio that this budget could see
  std::string places;       // in how many groups the falls of both lie (DescribeGroups)
  std::string verdict;      // one sentence
};
/// @param goal  of what the budget could see.
[[nodiscard]] Comparison Compare(const CampaignResults& results, const std::string& a,
                                 const std::string& b, const std::vector<std::string>& point,
                                 const TestGoal& goal = {});

/// Falls of an arm over its metres at a point (empty: over the whole sweep).
[[nodiscard]] RateEstimate PoolFalls(const CampaignResults& results, const std::string& arm,
                                     const std::vector<std::string>& point);

/// Those of two arms by seed, which is a terrain that both walked, by rising seed.
[[nodiscard]] std::vector<PairedCounts> CountByTerrain(const CampaignResults& results,
                                                       const std::string& a, const std::string& b,
                                                       const std::vector<std::string>& point);

/// The lower of two rates by which falls are expected, per metre; the other where it is zero.
[[nodiscard]] double LowerRate(const Comparison& c) noexcept;

/// Grounds that arms walked at a point (empty: over the whole sweep).
[[nodiscard]] std::size_t CountGrounds(const CampaignResults& results,
                                       const std::vector<std::string>& arms,
                                       const std::vector<std::string>& point);

/// "speed 0.3, roughness 1" or "all".
[[nodiscard]] std::string PointName(const std::vector<Axis>& axes,
                                    const std::vector<std::string>& point);

/// "133.5 m (95 %: 37 to 1102 m)", or "> 49 m (no fall in 180 m)".
[[nodiscard]] std::string MetresPerFall(const RateEstimate& falls);
/// Likewise; a dash where nobody counted falls.
[[nodiscard]] std::string MetresPerFall(const Cell& cell);

/// "-0.52 (95 %: -0.61 to -0.43)", the mean alone for a single value, a dash for none.
/// @param scale to the unit shown.
[[nodiscard]] std::string FormatDifference(const MeanEstimate& e, double scale, int digits);

/// Every arm at every point of the sweep.
[[nodiscard]] std::vector<Cell> AllCells(const CampaignResults& results,
                                         const Metrics& metrics = AllMetrics());

/// The whole sweep (empty), then each of its points where there is one.
[[nodiscard]] std::vector<std::vector<std::string>> SweepAndPoints(const std::vector<Axis>& axes);

/// Whether an episode is of an arm at a point (empty: any of the sweep).
[[nodiscard]] bool Belongs(const EpisodeRecord& e, const std::string& arm,
                           const std::vector<std::string>& point);

/// Every arm against the first, over the whole sweep and at each of its points.
[[nodiscard]] std::vector<Comparison> AllComparisons(const CampaignResults& results,
                                                     const TestGoal& goal = {});

/// Whether the interval of the ratio leaves out 1.
[[nodiscard]] bool ShowsDifference(const Comparison& c) noexcept;

}  // namespace scoria::analysis
