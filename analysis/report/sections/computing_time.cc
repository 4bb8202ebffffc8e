// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "analysis/plots/bar_plot.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"

namespace scoria::analysis {
namespace {

/// Solvers whose times are drawn, by the keys of the metrics.
struct Solver {
  const char* title;
  const char* median_key;
  const char* p99_key;
};
constexpr std::array<Solver, 2> kSolvers = {
    {{"MPC [us]", "mpc_median_s", "mpc_p99_s"}, {"WBC [us]", "wbc_median_s", "wbc_p99_s"}}};

bool HasTimes(const ReportInput& input, const Solver& solver) {
  return std::any_of(input.pooled.begin(), input.pooled.end(),
                     [&](const Cell& c) { return c.values.contains(solver.median_key); });
}

Block SolveTimes(const ReportInput& input) {
  BarPlot plot{"solve_times", "Solve times", input.results.arms, {}};
  for (const Solver& solver : kSolvers) {
    if (!HasTimes(input, solver)) continue;
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Bars median{"median", {}}, p99{"p99", {}};
    for (const Cell& cell : input.pooled) {
      median.values.push_back(Find(cell.values, solver.median_key).value_or(kNan) * 1e6);
      p99.values.push_back(Find(cell.values, solver.p99_key).value_or(kNan) * 1e6);
    }
    plot.panels.push_back({solver.title, {median, p99}});
  }
  if (plot.panels.empty()) return Paragraph{"No solve times were recorded."};
  return CaptionedFigure{
      DrawBars(plot),
      "Wall clock of one solve with its set-up: mean of the episodes' medians, worst of their "
      "99th percentiles."};
}

/// Wall-clock time of a step by stage, mean over the episodes of each arm.
Table StageTimes(const CampaignResults& results) {
  std::map<std::string, std::map<std::string, double>> us;  // by stage and arm
  std::map<std::string, double> episodes, total;
  for (const EpisodeRecord& e : results.episodes) {
    if (!e.has_metrics) continue;
    episodes[e.arm] += 1.0;
    for (const auto& [stage, time_us] : e.us_per_step) {
      us[stage][e.arm] += time_us;
      total[e.arm] += time_us;
    }
  }
  Table table{{"stage [us per step, share]"}, {}};
  table.header.insert(table.header.end(), results.arms.begin(), results.arms.end());
  for (const auto& [stage, per_arm] : us) {
    std::vector<std::string>& row = table.rows.emplace_back(1, stage);
    for (const std::string& arm : results.arms) {
      const double time_us = per_arm.contains(arm) ? per_arm.at(arm) : 0.0;
      row.push_back(episodes[arm] == 0.0 ? "–"
                                         : fmt::format("{:.2f} ({:.0f} %)", time_us / episodes[arm],
                                                       100.0 * time_us / total[arm]));
    }
  }
  return table;
}

std::optional<std::string> WhyNoComputingTime(const ReportInput& input) {
  if (!input.HasMetrics()) return "no episode left numbers";
  return std::nullopt;
}

Blocks BuildComputingTime(const ReportInput& input) {
  Blocks blocks = {SolveTimes(input)};
  const Table stages = StageTimes(input.results);
  if (stages.rows.empty()) {
    blocks.push_back(Paragraph{"Results of older versions hold no times of the stages."});
  } else {
    blocks.push_back(stages);
  }
  return blocks;
}

}  // namespace

Section ComputingTimeSection() {
  return {"computing_time", "Computing time", WhyNoComputingTime, BuildComputingTime};
}

}  // namespace scoria::analysis
