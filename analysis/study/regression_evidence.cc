// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/regression_evidence.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace scoria::analysis {
namespace {

/// Of the metrics that are looked at: falls are there once, and times of the clock are not.
bool IsJudged(const MetricInfo& info) {
  return info.better != Better::kNeither && info.family != MetricFamily::kTiming &&
         info.key != "falls_per_m";
}

/// An episode's arm and point.
using Place = std::pair<std::string, std::vector<std::string>>;
using ValuesByPlace = std::map<Place, MetricValues>;

ValuesByPlace ValuesOfSeed(const CampaignResults& results, const Metrics& metrics,
                           std::uint64_t seed) {
  ValuesByPlace values;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.seed == seed && e.has_metrics) values[{e.arm, e.point}] = ValuesOf(metrics, e.metrics);
  }
  return values;
}

/// Mean of a metric over the places; nothing where none has it.
std::optional<double> MeanOver(const ValuesByPlace& values, std::string_view key) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [place, of_place] : values) {
    if (const auto value = Find(of_place, key)) {
      sum += *value;
      ++count;
    }
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// Means of a pair over the places where both have the metric: baseline, now.
std::optional<std::pair<double, double>> PairOver(const ValuesByPlace& baseline,
                                                  const ValuesByPlace& now, std::string_view key) {
  double before = 0.0, after = 0.0;
  int count = 0;
  for (const auto& [place, values] : baseline) {
    const auto other = now.find(place);
    if (other == now.end()) continue;
    const auto a = Find(values, key), b = Find(other->second, key);
    if (!a || !b) continue;
    before += *a;
    after += *b;
    ++count;
  }
  if (count == 0) return std::nullopt;
  return std::pair(before / count, after / count);
}

/// The test of a metric, by its values on the seeds of the baseline.
std::variant<SequentialSignTest, SequentialTTest> ChooseTest(const std::vector<double>& values) {
  constexpr std::size_t kFewest = 10;
  constexpr double kDistinctShare = 0.9;
  const std::set<double> distinct(values.begin(), values.end());
  const auto n = static_cast<double>(values.size());
  if (values.size() < kFewest || static_cast<double>(distinct.size()) < kDistinctShare * n)
    return SequentialSignTest(Alternative::kGreater);
  double mean = 0.0, squares = 0.0;
  for (const double v : values) mean += v / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return SequentialTTest(Alternative::kGreater,
                         {.squares = squares, .count = static_cast<int>(values.size()) - 1});
}

}  // namespace

double RegressionEvidence::Test::log_e() const {
  return std::visit([](const auto& t) { return t.evidence().log_e(); }, test);
}

RegressionEvidence::RegressionEvidence(const CampaignResults& baseline) : metrics_(AllMetrics()) {
  std::erase_if(metrics_, [](const Metric& m) { return !IsJudged(m.info); });
  std::set<std::uint64_t> seeds;
  for (const EpisodeRecord& e : baseline.episodes) seeds.insert(e.seed);
  std::map<std::string_view, std::vector<double>> values;
  for (const std::uint64_t seed : seeds) {
    const ValuesByPlace of_seed = ValuesOfSeed(baseline, metrics_, seed);
    for (const Metric& m : metrics_) {
      if (const auto value = MeanOver(of_seed, m.info.key)) values[m.info.key].push_back(*value);
    }
  }
  for (const Metric& m : metrics_) {
    if (const auto found = values.find(m.info.key); found != values.end())
      tests_.push_back({m.info, ChooseTest(found->second)});
  }
}

void RegressionEvidence::AddSeed(std::uint64_t seed, const CampaignResults& baseline,
                                 const CampaignResults& now) {
  const ValuesByPlace before = ValuesOfSeed(baseline, metrics_, seed),
                      after = ValuesOfSeed(now, metrics_, seed);
  std::vector<double> all;
  for (Test& t : tests_) {
    if (const auto pair = PairOver(before, after, t.metric.key)) {
      const double worse = t.metric.better == Better::kLower ? 1.0 : -1.0;
      const double d = worse * (pair->second - pair->first) / std::numbers::sqrt2;
      std::visit([&](auto& test) { test.Add(d); }, t.test);
      ++t.pairs;
      t.baseline_sum += pair->first;
      t.sum += pair->second;
    }
    all.push_back(t.log_e());
  }
  if (!all.empty()) evidence_.Update(LogMeanExp(all));
}

std::vector<RegressionEvidence::Line> RegressionEvidence::Lines() const {
  std::vector<Line> lines;
  for (const Test& t : tests_) {
    if (t.pairs == 0) continue;
    const auto n = static_cast<double>(t.pairs);
    lines.push_back({t.metric, t.pairs, t.baseline_sum / n, t.sum / n, t.log_e()});
  }
  std::ranges::stable_sort(lines, std::ranges::greater{}, &Line::log_e);
  return lines;
}

}  // namespace scoria::analysis
