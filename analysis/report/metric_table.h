// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/metrics/metric_text.h"
#include "analysis/report/document.h"
#include "analysis/report/report_input.h"
#include "analysis/report/table.h"

namespace scoria::analysis {

/// In the unit shown; a dash for nothing.
[[nodiscard]] std::string MetricText(const MetricInfo& info, std::optional<double> value);

/// A table with a column more for each metric.
/// @param lines  one for each row of the table, with `values`.
template <class Line>
[[nodiscard]] Table WithMetrics(Table table, const std::vector<Line>& lines,
                                const Metrics& metrics) {
  for (const Metric& metric : metrics) {
    table.header.push_back(TitleWithUnit(metric.info));
    for (std::size_t i = 0; i < lines.size(); ++i)
      table.rows[i].push_back(MetricText(metric.info, Find(lines[i].values, metric.info.key)));
  }
  return table;
}

/// What the numbers of a section need, and no episode's rows had: "the log has no truth".
[[nodiscard]] std::optional<std::string> WhyNotValid(const ReportInput& input,
                                                     const logs::RowGroups& needs);

/// Likewise of a metric, which may take what stands in for the truth. Nothing where there is none
/// of that key.
[[nodiscard]] std::optional<std::string> WhyNotValid(const ReportInput& input,
                                                     std::string_view key);

/// The metrics of a family that the rows of no episode could give, each with the reason.
[[nodiscard]] Blocks NotValidNotes(const ReportInput& input, MetricFamily family);

}  // namespace scoria::analysis
