// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

/// A number of the summary of all intervals that are counted by `count`.
template <double ModelSummary::*value, int ModelSummary::*count>
std::optional<Measured> Of(const EpisodeMetrics& m) {
  const ModelSummary s = SummariseModel(m.model.intervals);
  return MeasuredIf(s.*count > 0, s.*value);
}

std::optional<Measured> SettledShare(const EpisodeMetrics& m) {
  const ModelSummary s = SummariseModel(m.model.intervals);
  if (s.judged == 0) return std::nullopt;
  return Measured{static_cast<double>(s.settled) / s.judged};
}

MetricInfo Info(std::string_view key, std::string_view title, std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kModel,
          .title = title,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueMass, RowGroup::kModel}),
          .better = Better::kLower,
          .pooling = Pooling::kAccumulated,
          .pooled_over = "of all intervals",
          .definition = definition};
}

MetricInfo MassInfo(std::string_view key, std::string_view title, std::string_view definition) {
  MetricInfo info = Info(key, title, definition);
  info.symbol = "m̂ − m";
  info.unit = "kg";
  info.digits = 3;
  return info;
}

MetricInfo ComInfo(std::string_view key, std::string_view title, std::string_view definition) {
  MetricInfo info = Info(key, title, definition);
  info.symbol = "ĉ − c";
  info.unit = "m";
  info.shown_unit = "mm";
  info.scale = 1e3;
  info.digits = 1;
  return info;
}

MetricInfo SettlingInfo() {
  MetricInfo info = Info("model_settling_median_s", "learned mass: median settling",
                         "Median time from a change of mass until the learned mass is and stays "
                         "within its margin; what did not settle counts with its whole duration.");
  info.symbol = "t_s";
  info.unit = "s";
  return info;
}

MetricInfo SettledInfo() {
  MetricInfo info = Info("model_settled_share", "learned mass: settled",
                         "Share of the judged intervals at whose end the learned mass was within "
                         "its margin.");
  info.shown_unit = "%";
  info.scale = 100.0;
  info.digits = 0;
  info.better = Better::kHigher;
  return info;
}

}  // namespace

Metrics ModelFamilyMetrics() {
  using S = ModelSummary;
  return {{MassInfo("model_bias_median_kg", "learned mass: median |bias|",
                    "Median over the settled intervals of |mean of learned minus true mass|."),
           Of<&S::median_bias_kg, &S::settled>},
          {MassInfo("model_bias_p95_kg", "learned mass: 95 % |bias|",
                    "95th percentile over the settled intervals of |mean of learned minus true "
                    "mass|."),
           Of<&S::p95_bias_kg, &S::settled>},
          {MassInfo("model_rmse_median_kg", "learned mass: median RMSE",
                    "Median over the settled intervals of the root mean square of learned minus "
                    "true mass."),
           Of<&S::median_rmse_kg, &S::settled>},
          {SettlingInfo(), Of<&S::median_settling_s, &S::judged>},
          {ComInfo("model_com_x_rmse_median_m", "learned COM x: RMSE",
                   "Median over the settled intervals of the root mean square of learned minus "
                   "true centre of mass, forward."),
           Of<&S::median_com_x_rmse_m, &S::settled>},
          {ComInfo("model_com_y_rmse_median_m", "learned COM y: RMSE",
                   "Median over the settled intervals of the root mean square of learned minus "
                   "true centre of mass, to the left."),
           Of<&S::median_com_y_rmse_m, &S::settled>},
          {SettledInfo(), SettledShare},
          {MassInfo("model_used_bias_median_kg", "mass acted on: median |bias|",
                    "Median over the intervals of |mean of the mass that the controller used minus "
                    "the true one|."),
           Of<&S::median_used_bias_kg, &S::used>}};
}

}  // namespace scoria::analysis
