// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

template <TimeQuantiles EpisodeMetrics::*solver, double TimeQuantiles::*value>
std::optional<Measured> Time(const EpisodeMetrics& m) {
  return MeasuredIf((m.*solver).count > 0, m.*solver.*value);
}

MetricInfo TimeInfo(std::string_view key, std::string_view title, int digits,
                    std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kTiming,
          .unit = "s",
          .title = title,
          .shown_unit = "µs",
          .scale = 1e6,
          .digits = digits,
          .needs = Groups({logs::RowGroup::kSolveTimes}),
          .better = Better::kLower,
          .definition = definition};
}

MetricInfo WorstTimeInfo(std::string_view key, std::string_view title, int digits,
                         std::string_view definition) {
  MetricInfo info = TimeInfo(key, title, digits, definition);
  info.pooling = Pooling::kLargest;
  return info;
}

}  // namespace

Metrics TimingMetrics() {
  using E = EpisodeMetrics;
  using Q = TimeQuantiles;
  return {{TimeInfo("mpc_median_s", "MPC median", 0,
                    "Median wall-clock time of one solve of the MPC with its set-up."),
           Time<&E::mpc, &Q::median_s>},
          {WorstTimeInfo("mpc_p99_s", "MPC p99", 0,
                         "99th percentile of the wall-clock time of one solve of the MPC."),
           Time<&E::mpc, &Q::p99_s>},
          {TimeInfo("wbc_median_s", "WBC median", 1,
                    "Median wall-clock time of one solve of the whole-body controller."),
           Time<&E::wbc, &Q::median_s>},
          {WorstTimeInfo("wbc_p99_s", "WBC p99", 1,
                         "99th percentile of the wall-clock time of one solve of the whole-body "
                         "controller."),
           Time<&E::wbc, &Q::p99_s>},
          {{.key = "real_time_factor",
            .family = MetricFamily::kTiming,
            .title = "real-time factor",
            .digits = 1,
            .better = Better::kHigher,
            .definition = "Simulated time over the wall-clock time of controller and physics."},
           [](const E& m) -> std::optional<Measured> {
             if (!m.outcome || !m.outcome->real_time_factor) return std::nullopt;
             return Measured{*m.outcome->real_time_factor};
           }}};
}

}  // namespace scoria::analysis
