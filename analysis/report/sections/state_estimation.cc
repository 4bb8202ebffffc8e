// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

bool Estimates(const Cell& c) { return c.sum && c.sum->estimation.present; }

std::string SegmentCount(const Cell& c) {
  const DriftSummary d = SummariseDrift(c.sum->estimation);
  if (d.segments == 0) return fmt::format("0 ({} short)", d.short_segments);
  if (d.used_short) return fmt::format("{}, all short", d.segments);
  return d.short_segments == 0 ? std::to_string(d.segments)
                               : fmt::format("{} ({} short)", d.segments, d.short_segments);
}

constexpr std::array<Column<Cell>, 1> kSegments = {{{"segments", SegmentCount}}};

std::optional<std::string> WhyNoStateEstimation(const ReportInput& input) {
  if (!input.HasMetrics()) return "no episode left numbers";
  if (std::any_of(input.cells.begin(), input.cells.end(), Estimates)) return std::nullopt;
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kEstimate}))) return reason;
  return "every episode walked on the true state";
}

Blocks BuildStateEstimation(const ReportInput& input) {
  std::vector<Cell> cells = input.cells;
  std::erase_if(cells, [](const Cell& c) { return !Estimates(c); });
  Blocks blocks = {WithMetrics(PointTable(input.results.axes, cells, kSegments), cells,
                               MetricsOf(input.metrics, MetricFamily::kEstimation))};
  for (Block& note : NotValidNotes(input, MetricFamily::kEstimation))
    blocks.push_back(std::move(note));
  blocks.push_back(Note{fmt::format(
      "Estimate against truth. Drift: medians of the magnitudes at the end of segments between "
      "placements and falls, in % of the way; short segments (below {:.0f} m) are left out where "
      "there are longer ones. RPE: root mean square over stretches of the path. NEES / 5 and NIS / "
      "dof are 1 for a consistent filter, above for an overconfident one.",
      kMinSegment_m)});
  return blocks;
}

}  // namespace

Section StateEstimationSection() {
  return {"state_estimation", "State estimation", WhyNoStateEstimation, BuildStateEstimation};
}

}  // namespace scoria::analysis
