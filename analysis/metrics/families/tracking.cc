// SPDX-License-Identifier: BSD-3-Clause

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"
#include "core/math/angles.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

template <std::optional<double> TrackingErrors::*value>
std::optional<Measured> Error(const EpisodeMetrics& m) {
  const TrackingErrors& t = m.tracking;
  if (t.samples_s <= 0.0 || !(t.*value)) return std::nullopt;
  return Measured{*(t.*value), t.samples_s};
}

template <double TrackingErrors::*value>
std::optional<Measured> Mean(const EpisodeMetrics& m) {
  const TrackingErrors& t = m.tracking;
  return MeasuredIf(t.samples_s > 0.0, t.*value, t.samples_s);
}

MetricInfo TrackingErrorInfo(std::string_view key, std::string_view symbol, std::string_view title,
                             std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kTracking,
          .symbol = symbol,
          .title = title,
          .needs = Groups(
              {RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kCommand, RowGroup::kReference}),
          .better = Better::kLower,
          .pooling = Pooling::kRms,
          .pooled_over = "steady time",
          .definition = definition,
          .takes_substitutes = true};
}

Metric VelocityError() {
  MetricInfo info = TrackingErrorInfo(
      "velocity_rmse_mps", "RMSE v", "velocity RMSE",
      "Root mean square of the trunk's horizontal velocity in its heading minus the command, "
      "averaged over a stride first.");
  info.unit = "m/s";
  info.digits = 3;
  info.needs = Groups({RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kCommand});
  return {info, Error<&TrackingErrors::velocity_rmse_mps>};
}

Metric HeightError() {
  MetricInfo info = TrackingErrorInfo(
      "height_rmse_m", "RMSE z", "height RMSE",
      "Root mean square of the height of the centre of mass minus the controller's reference.");
  info.unit = "m";
  info.shown_unit = "mm";
  info.scale = 1e3;
  info.digits = 1;
  info.needs |= Groups({RowGroup::kTrueMass});
  return {info, Error<&TrackingErrors::height_rmse_m>};
}

MetricInfo AngleInfo(std::string_view key, std::string_view symbol, std::string_view title,
                     std::string_view definition) {
  MetricInfo info = TrackingErrorInfo(key, symbol, title, definition);
  info.unit = "rad";
  info.shown_unit = "deg";
  info.scale = core::kDegreesPerRad;
  return info;
}

/// Of mean speeds and of the means of what was commanded.
MetricInfo SpeedInfo(std::string_view key, std::string_view title, std::string_view unit,
                     std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kTracking,
          .unit = unit,
          .title = title,
          .digits = 3,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kCommand}),
          .pooled_over = "steady time",
          .definition = definition,
          .takes_substitutes = true};
}

Metric StandingDrift() {
  return {{.key = "standing_drift_m",
           .family = MetricFamily::kTracking,
           .unit = "m",
           .title = "standing drift",
           .shown_unit = "mm",
           .scale = 1e3,
           .digits = 1,
           .needs = Groups({RowGroup::kEpisode, RowGroup::kTruth, RowGroup::kCommand}),
           .better = Better::kLower,
           .pooling = Pooling::kLargest,
           .definition = "Largest horizontal distance from where steady standing began.",
           .takes_substitutes = true},
          Error<&TrackingErrors::drift_m>};
}

}  // namespace

Metrics TrackingMetrics() {
  return {VelocityError(),
          HeightError(),
          {AngleInfo("roll_rmse_rad", "RMSE φ", "roll RMSE",
                     "Root mean square of the trunk's roll minus the controller's reference."),
           Error<&TrackingErrors::roll_rmse_rad>},
          {AngleInfo("pitch_rmse_rad", "RMSE θ", "pitch RMSE",
                     "Root mean square of the trunk's pitch minus the controller's reference."),
           Error<&TrackingErrors::pitch_rmse_rad>},
          {SpeedInfo("velocity_x_mps", "forward velocity", "m/s",
                     "Mean velocity along the heading while steady."),
           Mean<&TrackingErrors::velocity_x_mps>},
          {SpeedInfo("velocity_y_mps", "lateral velocity", "m/s",
                     "Mean velocity to the left of the heading while steady."),
           Mean<&TrackingErrors::velocity_y_mps>},
          {SpeedInfo("yaw_rate_radps", "yaw rate", "rad/s", "Mean yaw rate while steady."),
           Mean<&TrackingErrors::yaw_rate_radps>},
          {SpeedInfo("command_x_mps", "forward command", "m/s",
                     "Mean commanded forward velocity while steady."),
           Mean<&TrackingErrors::command_x_mps>},
          {SpeedInfo("command_y_mps", "lateral command", "m/s",
                     "Mean commanded lateral velocity while steady."),
           Mean<&TrackingErrors::command_y_mps>},
          {SpeedInfo("command_yaw_radps", "yaw command", "rad/s",
                     "Mean commanded yaw rate while steady."),
           Mean<&TrackingErrors::command_yaw_radps>},
          StandingDrift()};
}

}  // namespace scoria::analysis
