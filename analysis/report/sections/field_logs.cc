// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "core/config/field.h"

namespace scoria::analysis {
namespace {

std::optional<std::string> WhyNoFieldLogs(const ReportInput& /*input*/) { return std::nullopt; }

/// A row of each number that any log gave, a column of each log.
Table NumbersOf(const std::vector<FieldLog>& logs, const Metrics& metrics) {
  Table table{{"number"}, {}};
  for (const FieldLog& log : logs) table.header.push_back(log.id);
  for (const Metric& metric : metrics) {
    std::vector<std::string> row = {TitleWithUnit(metric.info)};
    bool any = false;
    for (const FieldLog& log : logs) {
      const std::optional<double> value = ValueOf(metric, log.metrics);
      any = any || value;
      row.push_back(MetricText(metric.info, value));
    }
    if (any) table.rows.push_back(std::move(row));
  }
  return table;
}

/// How the numbers were found, and why others were not.
BulletList SourcesOf(const FieldLog& log) {
  BulletList list;
  list.items.push_back(fmt::format("robot: {}", log.robot));
  list.items.push_back(fmt::format("mass: {}", log.mass));
  for (const auto& [group, source] : log.metrics.substitutes)
    list.items.push_back(fmt::format("{}: {}", core::EnumName(group), source));
  for (const auto& [key, reason] : log.metrics.withheld)
    list.items.push_back(fmt::format("no {}: {}", key, reason));
  list.items.insert(list.items.end(), log.remarks.begin(), log.remarks.end());
  return list;
}

Table FallsOf(const FieldLog& log) {
  Table table{{"fall at [s]", "told by"}, {}};
  for (const FallEvent& fall : log.metrics.falls)
    table.rows.push_back({fmt::format("{:.2f}", fall.time_s), fall.cause});
  return table;
}

Blocks BuildFieldLogs(const ReportInput& input) {
  const std::vector<FieldLog>& logs = input.results.logs;
  Blocks blocks = {NumbersOf(logs, input.metrics)};
  for (const FieldLog& log : logs) {
    blocks.push_back(Heading{log.id});
    blocks.push_back(SourcesOf(log));
    if (!log.metrics.falls.empty()) blocks.push_back(FallsOf(log));
    for (const CaptionedFigure& figure : log.figures) blocks.push_back(figure);
  }
  return blocks;
}

}  // namespace

Section FieldLogsSection() { return {"logs", "Logs", WhyNoFieldLogs, BuildFieldLogs}; }

}  // namespace scoria::analysis
