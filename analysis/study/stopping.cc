// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/study/stopping.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "analysis/statistics/paired_counts.h"
#include "analysis/study/results.h"
#include "core/demand.h"

namespace scoria::analysis {
namespace {

using nlohmann::json;

/// Falls of a beyond its share; nothing where an arm has no metres.
std::optional<double> ExcessOfFalls(std::span<const EpisodeRecord> episodes, const std::string& a,
                                    const std::string& b) {
  PairedCounts terrain;
  for (const EpisodeRecord& e : episodes) {
    if (!e.has_metrics || !e.metrics.outcome) continue;
    const PairedCounts of_a{e.metrics.outcome->falls, 0, e.metrics.distance_m, 0.0},
        of_b{0, e.metrics.outcome->falls, 0.0, e.metrics.distance_m};
    if (e.arm == a) terrain += of_a;
    if (e.arm == b) terrain += of_b;
  }
  if (terrain.exposure_a <= 0.0 || terrain.exposure_b <= 0.0) return std::nullopt;
  return ExcessOfA(terrain);
}

/// Mean over the points that both arms have the metric at.
std::optional<double> DifferenceOfMetric(std::span<const EpisodeRecord> episodes,
                                         const std::string& a, const std::string& b,
                                         const Metric& metric) {
  std::map<std::vector<std::string>, std::optional<double>> values_of_b;
  for (const EpisodeRecord& e : episodes) {
    if (e.arm == b && e.has_metrics) values_of_b[e.point] = ValueOf(metric, e.metrics);
  }
  double sum = 0.0;
  int count = 0;
  for (const EpisodeRecord& e : episodes) {
    if (e.arm != a || !e.has_metrics) continue;
    const auto value = ValueOf(metric, e.metrics), other = values_of_b[e.point];
    if (!value || !other) continue;
    sum += *value - *other;
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

}  // namespace

std::string DescribeStop(const StopRecord& r) {
  std::string compared;
  for (const StopRecord::Compared& c : r.comparisons)
    compared += fmt::format("{}{} against {} p = {:.2g}", compared.empty() ? "" : ", ", c.a, c.b,
                            c.p_any_time);
  const std::string end = r.last_seed ? fmt::format("Stopped by itself after seed {}", *r.last_seed)
                                      : fmt::format("Not decided in {} seeds", r.seeds);
  return fmt::format("{}: {} of {} (at any time; level {:g} % of each).", end, r.rule.when_decided,
                     compared, 100.0 * r.rule.alpha);
}

json ToJson(const StopRecord& r) {
  json comparisons = json::array();
  for (const StopRecord::Compared& c : r.comparisons)
    comparisons.push_back({{"a", c.a}, {"b", c.b}, {"p_any_time", c.p_any_time}});
  return {{"when_decided", r.rule.when_decided},
          {"alpha", r.rule.alpha},
          {"seeds", r.seeds},
          {"last_seed", r.last_seed ? json(*r.last_seed) : json(nullptr)},
          {"comparisons", std::move(comparisons)}};
}

StopRecord StopFromJson(const json& j) {
  StopRecord r;
  j.at("when_decided").get_to(r.rule.when_decided);
  j.at("alpha").get_to(r.rule.alpha);
  j.at("seeds").get_to(r.seeds);
  if (!j.at("last_seed").is_null()) r.last_seed = j.at("last_seed").get<std::uint64_t>();
  for (const json& c : j.at("comparisons"))
    r.comparisons.push_back({c.at("a"), c.at("b"), c.at("p_any_time")});
  return r;
}

SequentialStop::SequentialStop(const StopRule& rule, const std::vector<std::string>& arms) {
  SCORIA_DEMAND(arms.size() > 1, "{} arms", arms.size());
  record_.rule = rule;
  if (rule.when_decided != kFallsKey) {
    const Metrics metrics = AllMetrics();
    const Metric* metric = FindMetric(metrics, rule.when_decided);
    SCORIA_DEMAND(metric != nullptr, "{}", rule.when_decided);
    metric_ = *metric;
  }
  for (std::size_t i = 1; i < arms.size(); ++i)
    record_.comparisons.push_back({arms[i], arms[0], 1.0});
  tests_.resize(record_.comparisons.size());
}

std::optional<double> SequentialStop::Difference(std::span<const EpisodeRecord> episodes,
                                                 const std::string& a, const std::string& b) const {
  return metric_ ? DifferenceOfMetric(episodes, a, b, *metric_) : ExcessOfFalls(episodes, a, b);
}

void SequentialStop::AddSeed(std::uint64_t seed, std::span<const EpisodeRecord> episodes) {
  ++record_.seeds;
  for (std::size_t i = 0; i < tests_.size(); ++i) {
    StopRecord::Compared& c = record_.comparisons[i];
    if (const auto difference = Difference(episodes, c.a, c.b)) tests_[i].Add(*difference);
    c.p_any_time = tests_[i].evidence().p_value();
  }
  if (std::ranges::all_of(tests_, [&](const SequentialSignTest& test) {
        return test.evidence().Rejects(record_.rule.alpha);
      }))
    record_.last_seed = seed;
}

}  // namespace scoria::analysis
