// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <numbers>

#include "analysis/plots/bar_plot.h"
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// Errors that are drawn, and the scale to their unit.
struct Error {
  const char* title;
  double TrackingErrors::*value;
  double scale;
};
constexpr std::array<Error, 4> kErrors = {
    {{"velocity [mm/s], stride mean", &TrackingErrors::velocity_rmse_mps, 1e3},
     {"height [mm]", &TrackingErrors::height_rmse_m, 1e3},
     {"roll [deg]", &TrackingErrors::roll_rmse_rad, kDegrees},
     {"pitch [deg]", &TrackingErrors::pitch_rmse_rad, kDegrees}}};

bool WalkedSteadily(const Cell& cell) { return cell.tracking.samples_s > 0.0; }

std::optional<std::string> WhyNot(const ReportInput& input) {
  if (std::any_of(input.pooled.begin(), input.pooled.end(), WalkedSteadily)) return std::nullopt;
  return "no episode walked steadily";
}

Blocks Build(const ReportInput& input) {
  BarPlot plot{"tracking", "RMS tracking errors over steady walking", input.results.arms, {}};
  for (const Error& error : kErrors) {
    Bars bars;
    for (const Cell& cell : input.pooled) {
      bars.values.push_back(WalkedSteadily(cell) ? cell.tracking.*error.value * error.scale
                                                 : std::numeric_limits<double>::quiet_NaN());
    }
    plot.panels.push_back({error.title, {bars}});
  }
  return {CaptionedFigure{DrawBars(plot),
                          "Against the controller's reference, pooled over the sweep; the first "
                          "three seconds after each change of command are left out."}};
}

}  // namespace

Section TrackingSection() { return {"tracking", "Tracking", WhyNot, Build}; }

}  // namespace scoria::analysis
