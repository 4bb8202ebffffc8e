// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/set_comparison.h"

#include <cmath>

#include <fmt/format.h>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/metric_text.h"
#include "analysis/statistics/multiplicity.h"

namespace scoria::analysis {
namespace {

bool IsCompared(const MetricInfo& info) {
  return info.pooling != Pooling::kSum && info.family != MetricFamily::kTiming;
}

std::vector<double> ValuesOf(const std::vector<MetricValues>& walks, std::string_view key) {
  std::vector<double> values;
  for (const MetricValues& walk : walks) {
    const auto found = walk.find(key);
    if (found != walk.end() && std::isfinite(found->second)) values.push_back(found->second);
  }
  return values;
}

std::vector<MetricValues> AllValues(std::span<const EpisodeMetrics> walks, const Metrics& metrics) {
  std::vector<MetricValues> values;
  for (const EpisodeMetrics& walk : walks) values.push_back(ValuesOf(metrics, walk));
  return values;
}

/// Groups that the logs of some walks have, and something else stands in for in others.
logs::RowGroups MixedSources(std::span<const EpisodeMetrics> a, std::span<const EpisodeMetrics> b) {
  logs::RowGroups stand_in, own;
  for (const auto& walks : {a, b}) {
    for (const EpisodeMetrics& walk : walks) {
      logs::RowGroups replaced;
      for (const auto& [group, source] : walk.substitutes)
        replaced.set(static_cast<std::size_t>(group));
      stand_in |= replaced;
      own |= ~replaced;
    }
  }
  return stand_in & own;
}

std::string Shown(const MetricInfo& info, double value) {
  const std::string_view unit = ShownUnit(info);
  return ShownNumber(info, value) + (unit.empty() ? "" : fmt::format(" {}", unit));
}

}  // namespace

SetComparison CompareSets(std::span<const EpisodeMetrics> a, std::span<const EpisodeMetrics> b,
                          const Metrics& metrics) {
  const std::vector<MetricValues> first = AllValues(a, metrics), second = AllValues(b, metrics);
  const logs::RowGroups mixed = MixedSources(a, b);
  SetComparison out;
  std::vector<SetDifference>& all = out.metrics;
  std::vector<double> p;
  for (const Metric& metric : metrics) {
    if (!IsCompared(metric.info)) continue;
    const std::vector<double> of_a = ValuesOf(first, metric.info.key),
                              of_b = ValuesOf(second, metric.info.key);
    if (of_a.empty() || of_b.empty()) continue;
    if ((metric.info.needs & mixed).any()) {
      out.other_sources.push_back(metric.info);
      continue;
    }
    all.push_back({metric.info, CompareSamples(of_a, of_b), {}});
    if (all.back().samples.p) p.push_back(*all.back().samples.p);
  }
  const std::vector<double> adjusted = AdjustHolm(p);
  auto next = adjusted.begin();
  for (SetDifference& d : all) {
    if (d.samples.p) d.p_adjusted = *next++;
  }
  return out;
}

bool IsDifferent(const SetDifference& d, double alpha) {
  return d.p_adjusted && *d.p_adjusted <= alpha;
}

std::string DescribeDifference(const SetDifference& d, double alpha) {
  const TwoSamples& s = d.samples;
  const std::string a = Shown(d.metric, s.mean_a), b = Shown(d.metric, s.mean_b);
  if (!s.p) {
    return s.count_a + s.count_b < 3
               ? fmt::format(
                     "{}: {} and {}; with a walk on each side, how much walks vary is not "
                     "known",
                     d.metric.title, a, b)
               : fmt::format(
                     "{}: {} and {}; it does not vary within the sets, so that there is "
                     "nothing to test with",
                     d.metric.title, a, b);
  }
  if (!IsDifferent(d, alpha))
    return fmt::format("{}: no evidence of a difference, {} and {} (p = {:.2g} over all metrics)",
                       d.metric.title, a, b, *d.p_adjusted);
  return fmt::format(
      "{} is {} in the second: {}, not {} ({:.1f} deviations of a walk, p = {:.2g} "
      "over all metrics)",
      d.metric.title, s.mean_b > s.mean_a ? "larger" : "smaller", b, a, std::abs(*s.effect),
      *d.p_adjusted);
}

}  // namespace scoria::analysis
