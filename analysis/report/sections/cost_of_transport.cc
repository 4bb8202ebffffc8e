// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "analysis/plots/fit_plot.h"
#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"

namespace scoria::analysis {
namespace {

/// Costs that are drawn against speed.
struct Cost {
  const char* name;  // of the figure: cot_NAME
  const char* label;
  double SpeedWindow::*value;
};
constexpr std::array<Cost, 2> kCosts = {
    {{"mech_abs", "mechanical Σ|τω|", &SpeedWindow::cot_mech_abs},
     {"electrical", "electrical with idle power", &SpeedWindow::cot_electrical}}};

/// Slower than this a window is no walking.
constexpr double kSlowest_mps = 0.02;

/// The terms that an arm's windows carry, 1 to 3: commanded speeds, in steps of 0.1 m/s, that hold
/// at least a twentieth of the windows each.
int CurveTerms(const std::vector<double>& commands_mps) {
  std::map<long, std::size_t> counts;
  for (const double v_mps : commands_mps) ++counts[std::lround(10.0 * v_mps)];
  const auto frequent = std::count_if(counts.begin(), counts.end(), [&](const auto& c) {
    return 20 * c.second >= commands_mps.size();
  });
  return std::clamp(static_cast<int>(frequent), 1, 3);
}

struct ArmCost {
  FitSeries series;
  int terms = 0;  // of the curve
};

ArmCost CostOf(const ReportInput& input, const std::string& arm, const Cost& cost) {
  std::vector<CurvePoint> points;
  std::vector<double> commands_mps;
  ArmCost result;
  result.series.arm = arm;
  for (std::size_t episode = 0; episode < input.results.episodes.size(); ++episode) {
    const EpisodeRecord& e = input.results.episodes[episode];
    if (e.arm != arm) continue;
    for (const SpeedWindow& w : e.metrics.windows) {
      if (w.v_mps < kSlowest_mps) continue;
      commands_mps.push_back(w.command_mps);
      points.push_back({w.v_mps, w.*cost.value, episode});
      result.series.points.push_back({w.v_mps, w.*cost.value});
    }
  }
  if (points.empty()) return result;
  constexpr std::uint64_t kBootstrapSeed = 1;
  result.terms = CurveTerms(commands_mps);
  result.series.fit = FitCostCurve(points, result.terms, kBootstrapSeed);
  return result;
}

CaptionedFigure CostFigure(const ReportInput& input, const Cost& cost) {
  FitPlot plot;
  plot.name = fmt::format("cot_{}", cost.name);
  plot.title = fmt::format("Cost of transport: {}", cost.label);
  plot.x_label = "speed [m/s]";
  plot.y_label = fmt::format("cost of transport, {}", cost.label);
  std::string formulas;
  for (const std::string& arm : input.results.arms) {
    ArmCost of_arm = CostOf(input, arm, cost);
    if (of_arm.series.fit.valid) {
      formulas += fmt::format("{}{}: {}", formulas.empty() ? "" : "; ", arm,
                              CostCurveFormula(of_arm.terms));
    }
    plot.series.push_back(std::move(of_arm.series));
  }
  return {DrawFits(plot), fmt::format("One point per steady five-second window (a speed v). Fitted "
                                      "robustly: {}. Band: 95 % by resampling episodes of the same "
                                      "speed; none with too few of them.",
                                      formulas.empty() ? "nothing" : formulas)};
}

std::optional<std::string> WhyNoCostOfTransport(const ReportInput& input) {
  for (const EpisodeRecord& e : input.results.episodes) {
    for (const SpeedWindow& w : e.metrics.windows) {
      if (w.v_mps >= kSlowest_mps) return std::nullopt;
    }
  }
  if (auto reason = WhyNotValid(input, "cot_mech_abs")) return reason;
  return "no episode walked steadily for five seconds";
}

Blocks BuildCostOfTransport(const ReportInput& input) {
  Blocks blocks;
  for (const Cost& cost : kCosts) blocks.push_back(CostFigure(input, cost));
  return blocks;
}

}  // namespace

Section CostOfTransportSection() {
  return {"cost_of_transport", "Cost of transport", WhyNoCostOfTransport, BuildCostOfTransport};
}

}  // namespace scoria::analysis
