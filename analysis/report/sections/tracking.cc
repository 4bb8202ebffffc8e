// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "analysis/plots/bar_plot.h"
#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

/// Errors that are drawn.
constexpr std::array<std::string_view, 4> kDrawnErrors = {"velocity_rmse_mps", "height_rmse_m",
                                                          "roll_rmse_rad", "pitch_rmse_rad"};

bool HasAny(const ReportInput& input, std::string_view key) {
  return std::any_of(input.pooled.begin(), input.pooled.end(),
                     [&](const Cell& cell) { return cell.values.contains(key); });
}

std::optional<std::string> WhyNoTracking(const ReportInput& input) {
  const auto drawn = [&](std::string_view key) { return HasAny(input, key); };
  if (std::any_of(kDrawnErrors.begin(), kDrawnErrors.end(), drawn)) return std::nullopt;
  if (auto reason = WhyNotValid(input, kDrawnErrors.front())) return reason;
  return "no episode walked steadily";
}

Blocks BuildTracking(const ReportInput& input) {
  BarPlot plot{"tracking", "RMS tracking errors over steady walking", input.results.arms, {}};
  for (const std::string_view key : kDrawnErrors) {
    const Metric* metric = FindMetric(input.metrics, key);
    if (metric == nullptr || !HasAny(input, key)) continue;
    Bars bars;
    for (const Cell& cell : input.pooled) {
      const std::optional<double> value = Find(cell.values, key);
      bars.values.push_back(value ? metric->info.scale * *value
                                  : std::numeric_limits<double>::quiet_NaN());
    }
    plot.panels.push_back({TitleWithUnit(metric->info), {bars}});
  }
  return {CaptionedFigure{DrawBars(plot),
                          "Against the controller's reference, pooled over the sweep; the first "
                          "three seconds after each change of command are left out. Velocity: "
                          "averaged over a stride first."}};
}

}  // namespace

Section TrackingSection() { return {"tracking", "Tracking", WhyNoTracking, BuildTracking}; }

}  // namespace scoria::analysis
