// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/factor_effects.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scoria::analysis {
namespace {

struct Mean {
  double sum = 0.0;
  int count = 0;
};

/// By point, in the order of the design.
std::vector<MetricValues> MeansByPoint(const CampaignResults& results, const std::string& arm,
                                       const Metrics& metrics) {
  std::map<std::vector<std::string>, std::map<std::string, Mean, std::less<>>> sums;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm != arm || !e.has_metrics) continue;
    for (const auto& [key, value] : ValuesOf(metrics, e.metrics)) {
      Mean& mean = sums[e.point][key];
      mean.sum += value;
      ++mean.count;
    }
  }
  std::vector<MetricValues> means;
  for (const std::vector<std::string>& point : results.design->points) {
    MetricValues& values = means.emplace_back();
    for (const auto& [key, mean] : sums[point]) values[key] = mean.sum / mean.count;
  }
  return means;
}

/// The responses of the rows in which no point lacks one.
std::vector<double> WholeRows(const std::vector<std::optional<double>>& responses,
                              std::size_t factors) {
  const std::size_t width = PointsPerRow(factors);
  std::vector<double> whole;
  for (std::size_t row = 0; (row + 1) * width <= responses.size(); ++row) {
    const auto first = responses.begin() + static_cast<std::ptrdiff_t>(row * width);
    const auto last = first + static_cast<std::ptrdiff_t>(width);
    if (!std::all_of(first, last, [](const auto& r) { return r.has_value(); })) continue;
    std::for_each(first, last, [&](const auto& r) { whole.push_back(*r); });
  }
  return whole;
}

}  // namespace

std::vector<FactorEffects> CalcFactorEffects(const CampaignResults& results, const std::string& arm,
                                             const Metrics& metrics) {
  std::vector<FactorEffects> all;
  if (!results.design) return all;
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  const std::size_t factors = results.design->factors.size();
  const std::vector<MetricValues> means = MeansByPoint(results, arm, metrics);
  for (const Metric& metric : metrics) {
    if (metric.info.better == Better::kNeither) continue;
    FactorEffects effects{arm, metric.info, {}, 0, {}};
    for (const MetricValues& values : means)
      effects.responses.push_back(Find(values, metric.info.key));
    if (std::none_of(effects.responses.begin(), effects.responses.end(),
                     [](const auto& r) { return r.has_value(); }))
      continue;
    const std::vector<double> whole = WholeRows(effects.responses, factors);
    effects.rows = whole.size() / PointsPerRow(factors);
    effects.indices = EstimateSobolIndices(whole, factors, kBootstrapSeed);
    all.push_back(std::move(effects));
  }
  return all;
}

std::vector<std::array<double, 2>> BinnedResponse(std::vector<std::array<double, 2>> points) {
  constexpr std::size_t kBins = 8, kLeast = 4;  // points of a bin
  std::sort(points.begin(), points.end());
  const std::size_t bins = std::clamp<std::size_t>(points.size() / kLeast, 1, kBins);
  std::vector<std::array<double, 2>> means;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const std::size_t first = bin * points.size() / bins, last = (bin + 1) * points.size() / bins;
    if (first == last) continue;
    std::array<double, 2> mean = {0.0, 0.0};
    for (std::size_t i = first; i < last; ++i) {
      mean[0] += points[i][0] / static_cast<double>(last - first);
      mean[1] += points[i][1] / static_cast<double>(last - first);
    }
    means.push_back(mean);
  }
  return means;
}

}  // namespace scoria::analysis
