// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

template <Leg leg, std::optional<double> (LegTiming::*value)() const>
std::optional<Measured> Of(const EpisodeMetrics& m) {
  const std::optional<double> found = (m.gait.legs[leg].*value)();
  return found ? std::optional(Measured{*found}) : std::nullopt;
}

MetricInfo GaitInfo(std::string_view key, std::string_view title, std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kGait,
          .title = title,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueContacts}),
          .pooling = Pooling::kAccumulated,
          .pooled_over = "mean over strides",
          .definition = definition,
          .takes_substitutes = true};
}

MetricInfo TimeInfo(std::string_view key, std::string_view title, std::string_view definition) {
  MetricInfo info = GaitInfo(key, title, definition);
  info.unit = "s";
  info.digits = 3;
  return info;
}

constexpr std::string_view kStride =
    "Mean time from touchdown to touchdown of the foot, of strides from 2/3 to 3/2 of the median; "
    "a "
    "foot that is off the ground, or on it, for less than 80 ms has not changed between stance and "
    "swing.";
constexpr std::string_view kStance =
    "Mean time from touchdown to lift-off of the foot, of the same strides.";
constexpr std::string_view kDuty = "Time on the ground over time, of the same strides.";
constexpr std::string_view kPhase =
    "When the foot touches down in the stride of the front left one, as a share of it: mean "
    "direction "
    "on the circle.";

}  // namespace

Metrics GaitMetrics() {
  using T = LegTiming;
  return {{TimeInfo("stride_fl_s", "stride FL", kStride), Of<Leg::kFL, &T::MeanStride>},
          {TimeInfo("stride_fr_s", "stride FR", kStride), Of<Leg::kFR, &T::MeanStride>},
          {TimeInfo("stride_hl_s", "stride HL", kStride), Of<Leg::kHL, &T::MeanStride>},
          {TimeInfo("stride_hr_s", "stride HR", kStride), Of<Leg::kHR, &T::MeanStride>},
          {TimeInfo("stance_fl_s", "stance FL", kStance), Of<Leg::kFL, &T::MeanStance>},
          {TimeInfo("stance_fr_s", "stance FR", kStance), Of<Leg::kFR, &T::MeanStance>},
          {TimeInfo("stance_hl_s", "stance HL", kStance), Of<Leg::kHL, &T::MeanStance>},
          {TimeInfo("stance_hr_s", "stance HR", kStance), Of<Leg::kHR, &T::MeanStance>},
          {GaitInfo("duty_fl", "duty FL", kDuty), Of<Leg::kFL, &T::Duty>},
          {GaitInfo("duty_fr", "duty FR", kDuty), Of<Leg::kFR, &T::Duty>},
          {GaitInfo("duty_hl", "duty HL", kDuty), Of<Leg::kHL, &T::Duty>},
          {GaitInfo("duty_hr", "duty HR", kDuty), Of<Leg::kHR, &T::Duty>},
          {GaitInfo("phase_fr", "phase FR", kPhase), Of<Leg::kFR, &T::Phase>},
          {GaitInfo("phase_hl", "phase HL", kPhase), Of<Leg::kHL, &T::Phase>},
          {GaitInfo("phase_hr", "phase HR", kPhase), Of<Leg::kHR, &T::Phase>}};
}

}  // namespace scoria::analysis
