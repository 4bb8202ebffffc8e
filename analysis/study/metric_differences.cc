// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/metric_differences.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include "analysis/statistics/multiplicity.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

/// The values of one episode of each of two arms, on the same seed at the same point.
struct EpisodePair {
  const MetricValues* arm = nullptr;
  const MetricValues* baseline = nullptr;
};

/// By seed.
using EpisodePairs = std::map<std::uint64_t, std::vector<EpisodePair>>;

/// A seed's episodes at different points are no independent pairs: their mean is one value.
MetricDifference CompareMetric(const MetricInfo& metric, const EpisodePairs& pairs) {
  std::vector<double> arm_means, baseline_means;
  for (const auto& [seed, episodes] : pairs) {
    double arm = 0.0, baseline = 0.0, count = 0.0;
    for (const EpisodePair& pair : episodes) {
      const auto a = Find(*pair.arm, metric.key), b = Find(*pair.baseline, metric.key);
      if (!a || !b) continue;
      arm += *a;
      baseline += *b;
      count += 1.0;
    }
    if (count == 0.0) continue;
    arm_means.push_back(arm / count);
    baseline_means.push_back(baseline / count);
  }
  constexpr std::uint64_t kBootstrapSeed = 20251017;
  return {metric, EstimateDifference(arm_means, baseline_means, kBootstrapSeed)};
}

/// The metrics that can be better or worse are one family of tests.
void AdjustForMany(std::vector<MetricDifference>& metrics) {
  std::vector<MetricDifference*> family;
  std::vector<double> p;
  for (MetricDifference& d : metrics) {
    if (d.metric.better == Better::kNeither || d.pairs.difference.count < 2) continue;
    family.push_back(&d);
    p.push_back(d.pairs.p_value);
  }
  const std::vector<double> holm = AdjustHolm(p), false_discovery = AdjustFalseDiscovery(p);
  for (std::size_t i = 0; i < family.size(); ++i) {
    family[i]->holm = holm[i];
    family[i]->false_discovery = false_discovery[i];
  }
}

}  // namespace

Judgement Judge(const MetricDifference& d) noexcept {
  if (d.metric.better == Better::kNeither) return Judgement::kNoDirection;
  constexpr double kLevel = 0.05;
  const MeanEstimate& e = d.pairs.difference;
  if (e.count < 2 || d.holm > kLevel) return Judgement::kNoneShown;
  const bool less = e.mean < 0.0;
  return less == (d.metric.better == Better::kLower) ? Judgement::kBetter : Judgement::kWorse;
}

const MetricDifference* ArmDifferences::Find(std::string_view key) const noexcept {
  const auto found = std::find_if(metrics.begin(), metrics.end(),
                                  [&](const auto& d) { return d.metric.key == key; });
  return found == metrics.end() ? nullptr : &*found;
}

MetricComparer::MetricComparer(const CampaignResults& results, const Metrics& metrics)
    : results_(results), metrics_(metrics) {
  for (const EpisodeRecord& e : results.episodes)
    values_.push_back(e.has_metrics ? ValuesOf(metrics, e.metrics) : MetricValues());
}

ArmDifferences MetricComparer::Compare(const std::string& arm, const std::string& baseline,
                                       const std::vector<std::string>& point) const {
  std::map<std::pair<std::uint64_t, std::vector<std::string>>, EpisodePair> by_place;
  for (std::size_t i = 0; i < results_.episodes.size(); ++i) {
    const EpisodeRecord& e = results_.episodes[i];
    if (!e.has_metrics) continue;
    EpisodePair& pair = by_place[{e.seed, e.point}];
    if (Belongs(e, arm, point)) pair.arm = &values_[i];
    if (Belongs(e, baseline, point)) pair.baseline = &values_[i];
  }
  EpisodePairs pairs;
  for (const auto& [place, pair] : by_place) {
    if (pair.arm != nullptr && pair.baseline != nullptr) pairs[place.first].push_back(pair);
  }
  ArmDifferences all{arm, baseline, point, {}};
  for (const Metric& metric : metrics_) {
    MetricDifference d = CompareMetric(metric.info, pairs);
    if (d.pairs.difference.count > 0) all.metrics.push_back(std::move(d));
  }
  AdjustForMany(all.metrics);
  return all;
}

std::vector<ArmDifferences> AllDifferences(const CampaignResults& results, const Metrics& metrics) {
  std::vector<ArmDifferences> all;
  const MetricComparer comparer(results, metrics);
  for (const auto& point : SweepAndPoints(results.axes)) {
    for (std::size_t a = 1; a < results.arms.size(); ++a)
      all.push_back(comparer.Compare(results.arms[a], results.arms[0], point));
  }
  return all;
}

}  // namespace scoria::analysis
