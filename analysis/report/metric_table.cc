// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/report/metric_table.h"

#include "analysis/metrics/metric_text.h"

namespace scoria::analysis {

std::string MetricText(const MetricInfo& info, std::optional<double> value) {
  return value ? ShownNumber(info, *value) : NumberText(std::nullopt, 0);
}

std::optional<std::string> WhyNotValid(const ReportInput& input, const logs::RowGroups& needs) {
  const logs::RowGroups missing = MissingGroups(needs, input.groups);
  if (missing.none()) return std::nullopt;
  return DescribeMissing(missing);
}

std::optional<std::string> WhyNotValid(const ReportInput& input, std::string_view key) {
  const Metric* metric = FindMetric(input.metrics, key);
  if (metric == nullptr) return std::nullopt;
  const logs::RowGroups missing = MissingGroups(metric->info, input.groups, input.substitutes);
  if (missing.none()) return std::nullopt;
  return DescribeMissing(missing);
}

Blocks NotValidNotes(const ReportInput& input, MetricFamily family) {
  Blocks notes;
  for (const std::string& line :
       DescribeNotValid(MetricsOf(input.metrics, family), input.groups, input.substitutes))
    notes.push_back(Note{line + "."});
  return notes;
}

}  // namespace scoria::analysis
