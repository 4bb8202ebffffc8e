// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

template <double CostOfTransport::*kind>
std::optional<Measured> Cost(const EpisodeMetrics& m) {
  if (!m.cot) return std::nullopt;
  return Measured{(*m.cot).*kind};
}

/// What the costs have in common.
MetricInfo CostInfo(std::string_view key, std::string_view symbol, std::string_view title,
                    std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kTransport,
          .symbol = symbol,
          .title = title,
          .digits = 2,
          .needs = Groups(
              {RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kTrueMass, RowGroup::kEnergy}),
          .better = Better::kLower,
          .pooling = Pooling::kAccumulated,
          .pooled_over = "ratio of sums",
          .definition = definition,
          .takes_substitutes = true};
}

}  // namespace

Metrics TransportMetrics() {
  return {{{.key = "duration_s",
            .family = MetricFamily::kTransport,
            .symbol = "t",
            .unit = "s",
            .title = "duration",
            .digits = 1,
            .pooling = Pooling::kSum,
            .definition = "Time of the last row."},
           [](const EpisodeMetrics& m) { return MeasuredIf(m.duration_s > 0.0, m.duration_s); }},
          {{.key = "walking_s",
            .family = MetricFamily::kTransport,
            .unit = "s",
            .title = "walking",
            .digits = 1,
            .needs = Groups({RowGroup::kEpisode}),
            .pooling = Pooling::kSum,
            .definition = "Time in which the walking controller was in charge of a robot that had "
                          "not fallen.",
            .takes_substitutes = true},
           [](const EpisodeMetrics& m) { return MeasuredIf(true, m.walking_s); }},
          {{.key = "distance_m",
            .family = MetricFamily::kTransport,
            .symbol = "d",
            .unit = "m",
            .title = "distance",
            .digits = 1,
            .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth}),
            .pooling = Pooling::kSum,
            .definition = "Sum of half-second chords of the true trunk's path, placements "
                          "excluded.",
            .takes_substitutes = true},
           [](const EpisodeMetrics& m) { return MeasuredIf(true, m.distance_m); }},
          {CostInfo("cot_mech_abs", "C_abs", "CoT mech_abs",
                    "Cost of transport: Σ|τω| of the motors over ∫ m g ds."),
           Cost<&CostOfTransport::mech_abs>},
          {CostInfo("cot_mech_pos", "C_pos", "CoT mech_pos",
                    "Cost of transport: Σmax(τω, 0) of the motors over ∫ m g ds."),
           Cost<&CostOfTransport::mech_pos>},
          {CostInfo("cot_electrical", "C_el", "CoT electrical",
                    "Cost of transport: idle power, copper losses and motors' work without "
                    "regeneration over ∫ m g ds."),
           Cost<&CostOfTransport::electrical>},
          {CostInfo("cot_battery", "C_bat", "CoT battery",
                    "Cost of transport: what the cells deliver, inner losses included, over "
                    "∫ m g ds."),
           Cost<&CostOfTransport::battery>}};
}

}  // namespace scoria::analysis
