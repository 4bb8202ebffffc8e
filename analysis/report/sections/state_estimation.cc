// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <numbers>

#include <fmt/format.h>

#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct EstimationLine {
  std::string arm;
  std::vector<std::string> point;
  EstimationMetrics m;
  DriftSummary drift;
};

std::string SegmentCount(const DriftSummary& d) {
  if (d.segments == 0) return fmt::format("0 ({} short)", d.short_segments);
  if (d.used_short) return fmt::format("{}, all short", d.segments);
  return d.short_segments == 0 ? std::to_string(d.segments)
                               : fmt::format("{} ({} short)", d.segments, d.short_segments);
}

std::string DriftText(const DriftSummary& d, double value, int digits) {
  return NumberText(When(d.segments > 0, value), digits);
}

std::string PoseErrorText(const RelativePoseError& e) {
  const bool any = e.stretches > 0;
  return NumberText(When(any, 1e3 * e.horizontal_rms_m), 1) + " / " +
         NumberText(When(any, 1e3 * e.vertical_rms_m), 1);
}

std::string ErrorText(const EstimationMetrics& m, double value, int digits) {
  return NumberText(When(m.rows > 0, value), digits);
}

using L = EstimationLine;
constexpr std::array<Column<L>, 12> kColumns = {{
    {"segments", [](const L& l) { return SegmentCount(l.drift); }},
    {"horizontal drift [%]",
     [](const L& l) { return DriftText(l.drift, l.drift.horizontal_pct, 2); }},
    {"vertical drift [%]", [](const L& l) { return DriftText(l.drift, l.drift.vertical_pct, 2); }},
    {"yaw drift [deg/m]", [](const L& l) { return DriftText(l.drift, l.drift.yaw_deg_per_m, 3); }},
    {"RPE 1 m, horizontal / vertical [mm]", [](const L& l) { return PoseErrorText(l.m.rpe_1m); }},
    {"RPE 10 m, horizontal / vertical [mm]", [](const L& l) { return PoseErrorText(l.m.rpe_10m); }},
    {"velocity RMSE [mm/s]",
     [](const L& l) { return ErrorText(l.m, 1e3 * l.m.velocity_rmse_mps, 1); }},
    {"roll RMSE [deg]", [](const L& l) { return ErrorText(l.m, kDegrees * l.m.roll_rmse_rad, 2); }},
    {"pitch RMSE [deg]",
     [](const L& l) { return ErrorText(l.m, kDegrees * l.m.pitch_rmse_rad, 2); }},
    {"NEES / 5", [](const L& l) { return NumberText(When(l.m.nees_rows > 0, l.m.nees_ratio), 2); }},
    {"NIS / dof", [](const L& l) { return NumberText(When(l.m.nis_dof > 0, l.m.nis_ratio), 2); }},
    {"foot force RMSE, stance / swing [N]",
     [](const L& l) {
       return NumberText(When(l.m.force_stance_rows > 0, l.m.force_stance_rmse_N), 1) + " / " +
              NumberText(When(l.m.force_swing_rows > 0, l.m.force_swing_rmse_N), 1);
     }},
}};

std::optional<std::string> WhyNot(const ReportInput& input) {
  if (!input.HasMetrics()) return "no episode left numbers";
  const bool any = std::any_of(input.cells.begin(), input.cells.end(),
                               [](const Cell& c) { return c.estimation.present; });
  if (!any) return "every episode walked on the true state";
  return std::nullopt;
}

Blocks Build(const ReportInput& input) {
  std::vector<EstimationLine> lines;
  for (const Cell& c : input.cells) {
    if (c.estimation.present)
      lines.push_back({c.arm, c.point, c.estimation, SummariseDrift(c.estimation)});
  }
  return {PointTable(input.results.axes, lines, kColumns),
          Note{fmt::format(
              "Estimate against truth. Drift: medians of the magnitudes at the end of segments "
              "between placements and falls, in % of the way; short segments (below {:.0f} m) are "
              "left out where there are longer ones. RPE: root mean square over stretches of the "
              "path. NEES / 5 and NIS / dof are 1 for a consistent filter, above for an "
              "overconfident one.",
              kMinSegment_m)}};
}

}  // namespace

Section StateEstimationSection() { return {"state_estimation", "State estimation", WhyNot, Build}; }

}  // namespace scoria::analysis
