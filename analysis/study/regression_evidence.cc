// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/regression_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "analysis/statistics/paired_counts.h"

namespace scoria::analysis {
namespace {

/// Of the metrics that are looked at: falls are there once, and times of the clock are not.
bool IsJudged(const MetricInfo& info) {
  return info.better != Better::kNeither && info.family != MetricFamily::kTiming &&
         info.key != "falls_per_m";
}

using Place = RegressionEvidence::Place;
using EpisodesByPlace = std::map<Place, const EpisodeRecord*>;

EpisodesByPlace EpisodesOfSeed(const CampaignResults& results, std::uint64_t seed) {
  EpisodesByPlace episodes;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.seed == seed && e.has_metrics) episodes[{e.arm, e.point}] = &e;
  }
  return episodes;
}

/// Falls of `now` beyond its share of those of both; nothing where none of them has metres.
std::optional<double> ExcessOfFalls(const EpisodeRecord& before, const EpisodeRecord& now) {
  if (!before.metrics.outcome || !now.metrics.outcome) return std::nullopt;
  const PairedCounts falls{now.metrics.outcome->falls, before.metrics.outcome->falls,
                           now.metrics.distance_m, before.metrics.distance_m};
  if (falls.exposure_a <= 0.0 && falls.exposure_b <= 0.0) return std::nullopt;
  return ExcessOfA(falls);
}

constexpr std::size_t kFewest = 10;  // seeds that tell a scale

/// Whether values are averages over an episode, which hardly repeat.
bool AreContinuous(const std::vector<double>& values) {
  constexpr double kDistinctShare = 0.9;
  const std::set<double> distinct(values.begin(), values.end());
  return values.size() >= kFewest && static_cast<double>(distinct.size()) >=
                                         kDistinctShare * static_cast<double>(values.size());
}

SequentialTTest::Pilot SpreadOf(const std::vector<double>& values) {
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / static_cast<double>(values.size());
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {squares, static_cast<int>(values.size()) - 1};
}

/// Of differences between twin and baseline, which have twice the variance of a walk; nothing where
/// they do not tell a scale: of thirty normal ones, the largest is beyond four times their root
/// mean square once in 500 times.
std::optional<SequentialTTest::Pilot> SpreadOfTwins(const std::vector<double>& differences) {
  constexpr double kOutlier = 4.0;
  if (!AreContinuous(differences)) return std::nullopt;
  double squares = 0.0, largest = 0.0;
  for (const double d : differences) {
    squares += d * d;
    largest = std::max(largest, d * d);
  }
  const auto n = static_cast<double>(differences.size());
  if (largest > kOutlier * kOutlier * squares / n) return std::nullopt;
  return SequentialTTest::Pilot{0.5 * squares, static_cast<int>(differences.size())};
}

/// Values of a metric at a place by seed.
std::map<std::uint64_t, double> ValuesAt(const CampaignResults& results, const Place& place,
                                         const Metric& metric) {
  std::map<std::uint64_t, double> values;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics || e.arm != place.arm || e.point != place.point) continue;
    if (const auto value = ValueOf(metric, e.metrics)) values[e.seed] = *value;
  }
  return values;
}

}  // namespace

double RegressionEvidence::Test::log_e() const {
  return std::visit([](const auto& t) { return t.evidence().log_e(); }, test);
}

void RegressionEvidence::Test::Add(double before, double now, double worse) {
  std::visit([&](auto& t) { t.Add(worse); }, test);
  ++pairs;
  baseline_sum += before;
  sum += now;
}

RegressionEvidence::Test RegressionEvidence::MakeTest(const Metric& metric, const Place& place,
                                                      const CampaignResults& baseline) const {
  std::vector<double> values, differences;
  const auto twins = ValuesAt(twin_, place, metric);
  for (const auto& [seed, value] : ValuesAt(baseline, place, metric)) {
    values.push_back(value);
    if (const auto twin = twins.find(seed); twin != twins.end())
      differences.push_back(twin->second - value);
  }
  if (metric.info.key == kFallsKey || !AreContinuous(values))
    return {metric, place, SequentialSignTest(Alternative::kGreater)};
  if (const auto pilot = SpreadOfTwins(differences))
    return {metric, place, SequentialTTest(Alternative::kGreater, *pilot), true};
  return {metric, place, SequentialTTest(Alternative::kGreater, SpreadOf(values))};
}

RegressionEvidence::RegressionEvidence(const CampaignResults& baseline, CampaignResults twin)
    : twin_(std::move(twin)) {
  Metrics metrics = AllMetrics();
  std::erase_if(metrics, [](const Metric& m) { return !IsJudged(m.info); });
  std::set<Place> places;
  for (const EpisodeRecord& e : baseline.episodes) {
    if (e.has_metrics) places.insert({e.arm, e.point});
  }
  for (const Place& place : places) {
    for (const Metric& m : metrics) {
      if (!ValuesAt(baseline, place, m).empty()) tests_.push_back(MakeTest(m, place, baseline));
    }
  }
}

void RegressionEvidence::AddSeed(std::uint64_t seed, const CampaignResults& baseline,
                                 const CampaignResults& now) {
  const EpisodesByPlace before = EpisodesOfSeed(baseline, seed), twin = EpisodesOfSeed(twin_, seed),
                        after = EpisodesOfSeed(now, seed);
  std::vector<double> all;
  for (Test& t : tests_) {
    const auto a = before.find(t.place), b = after.find(t.place), again = twin.find(t.place);
    if (a != before.end() && b != after.end())
      AddPair(*a->second, again == twin.end() ? nullptr : again->second, *b->second, t);
    all.push_back(t.log_e());
  }
  if (!all.empty()) evidence_.Update(LogMeanExp(all));
}

void RegressionEvidence::AddPair(const EpisodeRecord& before, const EpisodeRecord* twin,
                                 const EpisodeRecord& now, Test& t) {
  const auto a = ValueOf(t.metric, before.metrics), b = ValueOf(t.metric, now.metrics);
  if (!a || !b) return;
  if (t.metric.info.key == kFallsKey) {
    if (const auto excess = ExcessOfFalls(before, now)) t.Add(*a, *b, *excess);
    return;
  }
  const auto again = t.by_twin && twin != nullptr ? ValueOf(t.metric, twin->metrics) : std::nullopt;
  // Of the variance of a walk: a mean of two has half of it.
  const double d =
      again ? (*b - 0.5 * (*a + *again)) / std::sqrt(1.5) : (*b - *a) / std::numbers::sqrt2;
  t.Add(*a, *b, t.metric.info.better == Better::kLower ? d : -d);
}

std::vector<RegressionEvidence::Line> RegressionEvidence::Lines() const {
  std::vector<Line> lines;
  for (const Test& t : tests_) {
    if (t.pairs == 0) continue;
    const auto n = static_cast<double>(t.pairs);
    lines.push_back({t.metric.info, t.place, t.pairs, t.baseline_sum / n, t.sum / n, t.log_e()});
  }
  std::ranges::stable_sort(lines, std::ranges::greater{}, &Line::log_e);
  return lines;
}

}  // namespace scoria::analysis
