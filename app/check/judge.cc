// SPDX-License-Identifier: BSD-3-Clause
#include "app/check/judge.h"

#include <algorithm>

#include <fmt/format.h>

#include "analysis/metrics/episode_metrics.h"

namespace scoria::app {
namespace {

using analysis::EpisodeMetrics;
using analysis::EpisodeRecord;

double CountOf(const Observable& what, const Episodes& episodes) {
  double sum = 0.0;
  for (const EpisodeRecord* e : episodes) {
    const auto& counts = what.source == Observable::Source::kEvent ? e->events : e->counters;
    const auto found = counts.find(what.key);
    if (found != counts.end()) sum += static_cast<double>(found->second);
  }
  return sum;
}

}  // namespace

std::optional<double> ExpectationJudge::ValueOf(const Observable& what,
                                                const Episodes& episodes) const {
  if (what.source != Observable::Source::kMetric) return CountOf(what, episodes);
  std::vector<const EpisodeMetrics*> measured;
  for (const EpisodeRecord* e : episodes) measured.push_back(&e->metrics);
  EpisodeMetrics sum = *measured.front();
  for (std::size_t i = 1; i < measured.size(); ++i) sum += *measured[i];
  const analysis::Metric* metric = analysis::FindMetric(metrics_, what.key);
  const analysis::MetricValues values = analysis::PoolValues({*metric}, sum, measured);
  const std::optional<double> value = analysis::Find(values, what.key);
  return value ? std::optional(what.scale * *value) : std::nullopt;
}

std::string ExpectationJudge::WhyNone(const Observable& what, const Episodes& episodes) const {
  const analysis::MetricInfo& info = analysis::FindMetric(metrics_, what.key)->info;
  for (const EpisodeRecord* e : episodes) {
    const logs::RowGroups missing = analysis::MissingGroups(info.needs, e->metrics.groups);
    if (missing.any()) return fmt::format("does not apply: {}", analysis::DescribeMissing(missing));
  }
  return fmt::format("does not apply, there was nothing to measure it on: {}", info.definition);
}

std::vector<Finding> ExpectationJudge::Compare(const Expectations& expected,
                                               const Episodes& episodes,
                                               const std::string& arm) const {
  std::vector<Finding> findings;
  for (const auto& [name, bounds] : expected) {
    const Observable& what = observables_.find(name)->second;
    Finding& finding = findings.emplace_back();
    finding.name = arm.empty() ? name : fmt::format("{} of {}", name, arm);
    finding.value = ValueOf(what, episodes);
    if (!finding.value) {
      finding.problem = WhyNone(what, episodes);
    } else if (const std::string breach = DescribeBreach(bounds, *finding.value); !breach.empty()) {
      finding.problem = fmt::format("is {:.6g}, {}", *finding.value, breach);
    }
  }
  return findings;
}

std::string DescribeNoWalk(const EpisodeRecord& episode) {
  if (!episode.message.empty()) return episode.message;
  if (!episode.has_metrics) return fmt::format("ended {} without a result", episode.end);
  return "";
}

}  // namespace scoria::app
