// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/judge_arms.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "analysis/statistics/mean.h"
#include "analysis/study/compare.h"

namespace scoria::app {
namespace {

using analysis::CampaignResults;
using analysis::EpisodeRecord;
using analysis::Interval;

Episodes EpisodesOf(const CampaignResults& results, const std::string& arm) {
  Episodes episodes;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm == arm) episodes.push_back(&e);
  }
  return episodes;
}

/// The two-sided confidence whose interval ends where the one-sided bound lies.
double TwoSided(double one_sided) { return 2.0 * one_sided - 1.0; }

/// Differences of a metric by seed, each of the means over the sweep, in the unit of `what`.
std::vector<double> Differences(const CampaignResults& results, const ArmComparison& c,
                                const Observable& what) {
  const analysis::Metrics metrics = analysis::AllMetrics();
  const analysis::Metric& metric = *analysis::FindMetric(metrics, what.key);
  std::map<std::pair<std::uint64_t, std::vector<std::string>>, std::array<std::optional<double>, 2>>
      pairs;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm == c.of) pairs[{e.seed, e.point}][0] = analysis::ValueOf(metric, e.metrics);
    if (e.arm == c.to) pairs[{e.seed, e.point}][1] = analysis::ValueOf(metric, e.metrics);
  }
  std::map<std::uint64_t, std::pair<double, int>> by_seed;
  for (const auto& [place, pair] : pairs) {
    if (!pair[0] || !pair[1]) continue;
    auto& [sum, count] = by_seed[place.first];
    sum += what.scale * (*pair[0] - *pair[1]);
    ++count;
  }
  std::vector<double> differences;
  for (const auto& [seed, mean] : by_seed) differences.push_back(mean.first / mean.second);
  return differences;
}

/// Whether an interval keeps to one side, as "is 0.41, at most 0.63 with 95 % confidence, which has
/// to be below 0.5".
std::string Breach(double value, const Interval& interval, double confidence,
                   const std::optional<double>& below, const std::optional<double>& above) {
  const double percent = 100.0 * confidence;
  if (below && !(interval.high < *below))
    return fmt::format("is {:.4g}, below {:.4g} with {:g} % confidence; must be below {:g}", value,
                       interval.high, percent, *below);
  if (above && !(interval.low > *above))
    return fmt::format("is {:.4g}, above {:.4g} with {:g} % confidence; must be above {:g}", value,
                       interval.low, percent, *above);
  return "";
}

Finding JudgeComparison(const std::string& name, const Observable& what, const ArmComparison& c,
                        const CampaignResults& results) {
  Finding finding;
  if (c.ratio_below || c.ratio_above) {
    finding.name = fmt::format("ratio of {}, {} : {},", name, c.of, c.to);
    const analysis::RatioEstimate ratio =
        analysis::CompareRates(
            analysis::PoolFalls(results, c.of, {}), analysis::PoolFalls(results, c.to, {}),
            analysis::CountByTerrain(results, c.of, c.to, {}), TwoSided(c.confidence))
            .judged;
    finding.value = ratio.ratio;
    finding.problem =
        Breach(ratio.ratio, ratio.interval, c.confidence, c.ratio_below, c.ratio_above);
    return finding;
  }
  finding.name = fmt::format("difference of {}, {} - {},", name, c.of, c.to);
  const std::vector<double> differences = Differences(results, c, what);
  if (differences.size() < 2) {
    finding.problem = "needs two seeds with a value of both arms at least";
    return finding;
  }
  const analysis::MeanEstimate mean = analysis::EstimateMean(differences, TwoSided(c.confidence));
  finding.value = mean.mean;
  finding.problem =
      Breach(mean.mean, mean.interval, c.confidence, c.difference_below, c.difference_above);
  return finding;
}

}  // namespace

std::vector<Finding> JudgeArms(const ArmExpectations& expected, const CampaignResults& results) {
  std::vector<Finding> findings;
  const ExpectationJudge judge;
  const Observables observables = AllObservables();
  for (const auto& [name, bounds] : expected) {
    for (const std::string& arm : results.arms) {
      const bool meant = bounds.arms.empty() || std::ranges::count(bounds.arms, arm) > 0;
      if (bounds.IsEmpty() || !meant) continue;
      for (Finding& f : judge.Compare({{name, bounds}}, EpisodesOf(results, arm), arm))
        findings.push_back(std::move(f));
    }
    for (const ArmComparison& c : bounds.compare)
      findings.push_back(JudgeComparison(name, observables.find(name)->second, c, results));
  }
  return findings;
}

}  // namespace scoria::app
