// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/families/families.h"

namespace scoria::analysis {
namespace {

using logs::RowGroup;

/// What is judged against the true contact.
MetricInfo JudgedInfo(std::string_view key, std::string_view title, std::string_view pooled_over,
                      std::string_view definition) {
  return {.key = key,
          .family = MetricFamily::kContact,
          .title = title,
          .needs = Groups({RowGroup::kEpisode, RowGroup::kTrueContacts, RowGroup::kContacts}),
          .better = Better::kHigher,
          .pooling = Pooling::kAccumulated,
          .pooled_over = pooled_over,
          .definition = definition};
}

Metric Accuracy() {
  MetricInfo info = JudgedInfo("contact_accuracy", "contact accuracy", "ratio of sums",
                               "Share of the rows of legs on which the fused contact was right, "
                               "outside ±15 ms of the true edges.");
  info.shown_unit = "%";
  info.scale = 100.0;
  return {info, [](const EpisodeMetrics& m) {
            const ContactMetrics& c = m.estimation.contact;
            return MeasuredIf(c.HasDetection(), c.of(ContactDetector::kFused).Accuracy());
          }};
}

Metric TouchdownDelay() {
  MetricInfo info = JudgedInfo("touchdown_delay_median_s", "touchdown delay", "median over edges",
                               "When the fused contact reports a touchdown, minus when it truly "
                               "was: the median.");
  info.unit = "s";
  info.shown_unit = "ms";
  info.scale = 1e3;
  info.digits = 0;
  info.better = Better::kLower;
  return {info, [](const EpisodeMetrics& m) {
            const ContactMetrics& c = m.estimation.contact;
            const DelayHistogram& delays = c.of(ContactDetector::kFused).touchdown.delays;
            return MeasuredIf(c.HasDetection() && delays.count() > 0, delays.Quantile(0.5));
          }};
}

template <Evidence ContactMetrics::*evidence>
std::optional<Measured> Area(const EpisodeMetrics& m) {
  const ContactMetrics& c = m.estimation.contact;
  return MeasuredIf(c.HasDetection(), (c.*evidence).Area());
}

Metric AreaMetric(std::string_view key, std::string_view title, std::string_view definition,
                  std::optional<Measured> (*find)(const EpisodeMetrics&)) {
  MetricInfo info = JudgedInfo(key, title, "of the added-up histograms", definition);
  info.symbol = "AUC";
  info.digits = 4;
  return {info, find};
}

}  // namespace

Metrics ContactFamilyMetrics() {
  return {Accuracy(),
          TouchdownDelay(),
          AreaMetric("sensor_auc", "AUC of the foot sensors",
                     "Area under the receiver operating characteristic of the foot sensors' "
                     "counts.",
                     Area<&ContactMetrics::sensor>),
          AreaMetric("observer_auc", "AUC of the momentum observer",
                     "Area under the receiver operating characteristic of the momentum observer's "
                     "contact probability.",
                     Area<&ContactMetrics::observer>),
          {{.key = "sensor_distrusted_share",
            .family = MetricFamily::kContact,
            .title = "sensor distrusted",
            .shown_unit = "%",
            .scale = 100.0,
            .digits = 2,
            .needs = Groups({RowGroup::kEpisode, RowGroup::kContacts}),
            .pooling = Pooling::kAccumulated,
            .pooled_over = "ratio of sums",
            .definition = "Share of the rows of legs with a foot sensor on which it was held "
                          "unhealthy."},
           [](const EpisodeMetrics& m) {
             const ContactMetrics& c = m.estimation.contact;
             return MeasuredIf(c.sensor_rows > 0, static_cast<double>(c.distrusted_rows) /
                                                      static_cast<double>(c.sensor_rows));
           }}};
}

}  // namespace scoria::analysis
