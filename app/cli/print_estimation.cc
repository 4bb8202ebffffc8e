// SPDX-License-Identifier: BSD-3-Clause
#include "app/cli/print_estimation.h"

#include <fmt/format.h>

#include "analysis/metrics/episode_metrics.h"
#include "analysis/metrics/metric_text.h"

namespace scoria::app {

void PrintEstimation(const char* what, const analysis::EstimationMetrics& estimation,
                     const logs::RowGroups& groups) {
  analysis::EpisodeMetrics m;
  m.estimation = estimation;
  m.groups = groups;
  analysis::Metrics metrics = analysis::AllMetrics();
  std::erase_if(metrics, [](const analysis::Metric& metric) {
    return metric.info.family != analysis::MetricFamily::kEstimation &&
           metric.info.family != analysis::MetricFamily::kContact;
  });
  fmt::print("{}\n{}", what, analysis::DescribeMetrics(metrics, m));
}

}  // namespace scoria::app
