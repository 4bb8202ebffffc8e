// SPDX-License-Identifier: BSD-3-Clause

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"
#include "core/math/angles.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

template <double DriftSummary::*value>
std::optional<Measured> Drift(const EpisodeMetrics& m) {
  const DriftSummary drift = SummariseDrift(m.estimation);
  return MeasuredIf(m.estimation.present && drift.segments > 0, drift.*value);
}

template <RelativePoseError EstimationMetrics::*way, double RelativePoseError::*value>
std::optional<Measured> PoseError(const EpisodeMetrics& m) {
  const RelativePoseError& error = m.estimation.*way;
  return MeasuredIf(m.estimation.present && error.stretches > 0, error.*value);
}

template <double EstimationMetrics::*value>
std::optional<Measured> Error(const EpisodeMetrics& m) {
  return MeasuredIf(m.estimation.present && m.estimation.rows > 0, m.estimation.*value);
}

template <double EstimationMetrics::*value, std::uint64_t EstimationMetrics::*count>
std::optional<Measured> Counted(const EpisodeMetrics& m) {
  return MeasuredIf(m.estimation.*count > 0, m.estimation.*value);
}

/// What the errors have in common. How a number is shown follows with Show.
MetricInfo ErrorInfo(std::string_view key, std::string_view symbol, std::string_view title,
                     std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kEstimation,
          .symbol = symbol,
          .title = title,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kEstimate}),
          .better = Better::kLower,
          .pooling = Pooling::kAccumulated,
          .pooled_over = "RMS over rows",
          .definition = definition};
}

struct Shown {
  std::string_view unit;
  double scale = 1.0;
  int digits = 2;
};

MetricInfo Show(MetricInfo info, std::string_view unit, const Shown& shown) {
  info.unit = unit;
  info.shown_unit = shown.unit;
  info.scale = shown.scale;
  info.digits = shown.digits;
  return info;
}

MetricInfo Over(MetricInfo info, std::string_view words) {
  info.pooled_over = words;
  return info;
}

MetricInfo Needing(MetricInfo info, std::initializer_list<RowGroup> groups) {
  info.needs = Groups(groups);
  return info;
}

Metrics DriftMetrics() {
  constexpr std::string_view kOver = "median over segments";
  return {{Over(Show(ErrorInfo("drift_horizontal_pct", "δ_xy", "horizontal drift",
                               "Horizontal error of the movement over a segment, in % of the way."),
                     "%", {"%", 1.0, 2}),
                kOver),
           Drift<&DriftSummary::horizontal_pct>},
          {Over(Show(ErrorInfo("drift_vertical_pct", "δ_z", "vertical drift",
                               "Vertical error of the movement over a segment, in % of the way."),
                     "%", {"%", 1.0, 2}),
                kOver),
           Drift<&DriftSummary::vertical_pct>},
          {Over(Show(ErrorInfo("drift_yaw_deg_per_m", "δ_ψ", "yaw drift",
                               "Error of the turn over a segment, over the way."),
                     "deg/m", {"deg/m", 1.0, 3}),
                kOver),
           Drift<&DriftSummary::yaw_deg_per_m>}};
}

MetricInfo PoseErrorInfo(std::string_view key, std::string_view symbol, std::string_view title,
                         std::string_view definition) {
  return Over(Show(ErrorInfo(key, symbol, title, definition), "m", {"mm", 1e3, 1}),
              "RMS over stretches");
}

Metrics PoseErrorMetrics() {
  using E = EstimationMetrics;
  using R = RelativePoseError;
  return {{PoseErrorInfo("rpe_1m_horizontal_m", "RPE_1,xy", "RPE 1 m horizontal",
                         "Root mean square of the horizontal error of the movement over 1 m."),
           PoseError<&E::rpe_1m, &R::horizontal_rms_m>},
          {PoseErrorInfo("rpe_1m_vertical_m", "RPE_1,z", "RPE 1 m vertical",
                         "Root mean square of the vertical error of the movement over 1 m."),
           PoseError<&E::rpe_1m, &R::vertical_rms_m>},
          {PoseErrorInfo("rpe_10m_horizontal_m", "RPE_10,xy", "RPE 10 m horizontal",
                         "Root mean square of the horizontal error of the movement over 10 m."),
           PoseError<&E::rpe_10m, &R::horizontal_rms_m>},
          {PoseErrorInfo("rpe_10m_vertical_m", "RPE_10,z", "RPE 10 m vertical",
                         "Root mean square of the vertical error of the movement over 10 m."),
           PoseError<&E::rpe_10m, &R::vertical_rms_m>}};
}

Metrics StateErrorMetrics() {
  using E = EstimationMetrics;
  return {
      {Show(ErrorInfo("est_velocity_rmse_mps", "RMSE v̂", "estimated velocity RMSE",
                      "Root mean square of the error of the trunk's velocity in its own frame."),
            "m/s", {"mm/s", 1e3, 1}),
       Error<&E::velocity_rmse_mps>},
      {Show(ErrorInfo("est_roll_rmse_rad", "RMSE φ̂", "estimated roll RMSE",
                      "Root mean square of estimated minus true roll."),
            "rad", {"deg", core::kDegreesPerRad, 2}),
       Error<&E::roll_rmse_rad>},
      {Show(ErrorInfo("est_pitch_rmse_rad", "RMSE θ̂", "estimated pitch RMSE",
                      "Root mean square of estimated minus true pitch."),
            "rad", {"deg", core::kDegreesPerRad, 2}),
       Error<&E::pitch_rmse_rad>}};
}

/// 1 for a consistent filter, so that neither direction is better.
Metrics ConsistencyMetrics() {
  using E = EstimationMetrics;
  MetricInfo nees = ErrorInfo("nees_ratio", "NEES / 5", "NEES / 5",
                              "Mean normalised estimation error squared of roll, pitch and body "
                              "velocity over its degrees of freedom; 1 for a consistent filter.");
  MetricInfo nis =
      Needing(ErrorInfo("nis_ratio", "NIS / dof", "NIS / dof",
                        "Sum of the normalised innovations squared of the feet over the sum of "
                        "their degrees of freedom; 1 for a consistent filter."),
              {RowGroup::kEpisode, RowGroup::kEstimate});
  nees.pooled_over = "mean over rows";
  nis.pooled_over = "ratio of sums";
  nees.better = nis.better = Better::kNeither;
  return {{nees, Counted<&E::nees_ratio, &E::nees_rows>},
          {nis, Counted<&E::nis_ratio, &E::nis_dof>}};
}

MetricInfo ForceInfo(std::string_view key, std::string_view symbol, std::string_view title,
                     std::string_view definition) {
  return Needing(Show(ErrorInfo(key, symbol, title, definition), "N", {"N", 1.0, 1}),
                 {RowGroup::kEpisode, RowGroup::kTrueContacts, RowGroup::kContacts});
}

Metrics ForceMetrics() {
  using E = EstimationMetrics;
  return {{ForceInfo("force_stance_rmse_N", "RMSE f̂_st", "foot force RMSE in stance",
                     "Root mean square of the error of the momentum observer's vertical force on "
                     "feet in true contact."),
           Counted<&E::force_stance_rmse_N, &E::force_stance_rows>},
          {ForceInfo("force_swing_rmse_N", "RMSE f̂_sw", "foot force RMSE in swing",
                     "Root mean square of the error of the momentum observer's vertical force on "
                     "feet in true swing."),
           Counted<&E::force_swing_rmse_N, &E::force_swing_rows>}};
}

}  // namespace

Metrics EstimationFamilyMetrics() {
  Metrics all;
  for (const auto part :
       {DriftMetrics, PoseErrorMetrics, StateErrorMetrics, ConsistencyMetrics, ForceMetrics}) {
    for (const Metric& metric : part()) all.push_back(metric);
  }
  return all;
}

}  // namespace scoria::analysis
