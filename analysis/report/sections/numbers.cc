// SPDX-License-Identifier: BSD-3-Clause
#include <array>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

constexpr std::array<Column<Cell>, 1> kRateColumn = {
    {{"metres per fall", [](const Cell& c) { return MetresPerFall(c); }}}};

/// Families that have no section of their own.
constexpr std::array<MetricFamily, 4> kFamilies = {MetricFamily::kSafety, MetricFamily::kTransport,
                                                   MetricFamily::kTracking, MetricFamily::kTiming};

std::optional<std::string> WhyNoNumbers(const ReportInput& /*input*/) { return std::nullopt; }

Blocks BuildNumbers(const ReportInput& input) {
  Blocks blocks;
  for (const MetricFamily family : kFamilies) {
    const bool safety = family == MetricFamily::kSafety;
    const Table lead =
        safety ? PointTable(input.results.axes, input.cells, kRateColumn)
               : PointTable(input.results.axes, input.cells, std::array<Column<Cell>, 0>{});
    blocks.push_back(WithMetrics(lead, input.cells, MetricsOf(input.metrics, family)));
    for (Block& note : NotValidNotes(input, family)) blocks.push_back(std::move(note));
  }
  return blocks;
}

}  // namespace

Section NumbersSection() { return {"numbers", "Numbers", WhyNoNumbers, BuildNumbers}; }

}  // namespace scoria::analysis
