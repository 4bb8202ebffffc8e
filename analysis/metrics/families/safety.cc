// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

std::optional<Measured> Falls(const EpisodeMetrics& m) {
  if (!m.outcome) return std::nullopt;
  return Measured{static_cast<double>(m.outcome->falls)};
}

std::optional<Measured> FallsPerMetre(const EpisodeMetrics& m) {
  if (!m.outcome || m.distance_m <= 0.0) return std::nullopt;
  return Measured{m.outcome->falls / m.distance_m};
}

std::optional<Measured> Stuck(const EpisodeMetrics& m) {
  if (!m.outcome || !m.outcome->stuck) return std::nullopt;
  return Measured{static_cast<double>(*m.outcome->stuck)};
}

std::optional<Measured> PeakFootForce(const EpisodeMetrics& m) {
  if (!m.peak_foot_force_N) return std::nullopt;
  return Measured{*m.peak_foot_force_N};
}

}  // namespace

Metrics SafetyMetrics() {
  return {{{.key = "falls",
            .family = MetricFamily::kSafety,
            .symbol = "N",
            .title = "falls",
            .digits = 0,
            .needs = Groups({RowGroup::kTruth}),
            .better = Better::kLower,
            .pooling = Pooling::kSum,
            .definition = "How many times the robot fell, by the true motion of its trunk.",
            .takes_substitutes = true},
           Falls},
          {{.key = "falls_per_m",
            .family = MetricFamily::kSafety,
            .symbol = "λ",
            .unit = "1/m",
            .title = "falls per metre",
            .digits = 4,
            .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth}),
            .better = Better::kLower,
            .pooling = Pooling::kAccumulated,
            .pooled_over = "ratio of sums",
            .definition = "Falls over distance.",
            .takes_substitutes = true},
           FallsPerMetre},
          {{.key = "stuck",
            .family = MetricFamily::kSafety,
            .title = "stuck",
            .digits = 0,
            .needs = Groups({RowGroup::kTruth}),
            .better = Better::kLower,
            .pooling = Pooling::kSum,
            .definition = "How many times the robot got stuck and was lifted on."},
           Stuck},
          {{.key = "peak_foot_force_N",
            .family = MetricFamily::kSafety,
            .symbol = "max |f|",
            .unit = "N",
            .title = "peak foot force",
            .digits = 0,
            .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueContacts}),
            .better = Better::kLower,
            .pooling = Pooling::kLargest,
            .definition = "Largest force of the ground on one foot while walking."},
           PeakFootForce}};
}

}  // namespace scoria::analysis
