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

Blocks NotValidNotes(const ReportInput& input, MetricFamily family) {
  Blocks notes;
  for (const std::string& line : DescribeNotValid(MetricsOf(input.metrics, family), input.groups))
    notes.push_back(Note{line + "."});
  return notes;
}

}  // namespace scoria::analysis
