// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/bias_budget.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

/// "-0.86 ± 0.12"; the mean alone for a single seed.
std::string MeanAndSpread(const MeanEstimate& e, double scale, int digits) {
  if (e.count == 0) return "–";
  const std::string mean = fmt::format("{:+.{}f}", scale * e.mean, digits);
  return e.count == 1 ? mean : fmt::format("{} ± {:.{}f}", mean, scale * e.deviation, digits);
}

using B = BiasLine;
constexpr std::array<Column<B>, 8> kBudgetColumns = {{
    {"seeds", [](const B& l) { return std::to_string(l.bias_kg.count); }},
    {"bias [kg]", [](const B& l) { return MeanAndSpread(l.bias_kg, 1.0, 2); }},
    {"change of the bias [kg]",
     [](const B& l) { return l.baseline ? "baseline" : FormatDifference(l.change_kg, 1.0, 2); }},
    {"after adding [kg]", [](const B& l) { return MeanAndSpread(l.added_kg, 1.0, 2); }},
    {"after removal [kg]", [](const B& l) { return MeanAndSpread(l.removed_kg, 1.0, 2); }},
    {"noise [kg]",
     [](const B& l) { return NumberText(When(l.noise_kg.count > 0, l.noise_kg.mean), 3); }},
    {"COM x [mm]", [](const B& l) { return MeanAndSpread(l.com_x_m, 1e3, 1); }},
    {"COM y [mm]", [](const B& l) { return MeanAndSpread(l.com_y_m, 1e3, 1); }},
}};

std::optional<std::string> WhyNoBiasBudget(const ReportInput& input) {
  const auto& axes = input.results.axes;
  const bool compares =
      std::any_of(axes.begin(), axes.end(), [](const Axis& a) { return !a.baseline.empty(); });
  if (!compares) return "no sweep names a baseline";
  if (auto reason = WhyNotValid(input, Groups({logs::RowGroup::kTrueMass}))) return reason;
  if (CalcBiasBudget(input.results).empty())
    return fmt::format("no arm learned its mass until {:.0f} s after a change", kLate_s);
  return std::nullopt;
}

Blocks BuildBiasBudget(const ReportInput& input) {
  return {PointTable(input.results.axes, CalcBiasBudget(input.results), kBudgetColumns),
          Note{fmt::format(
              "Learned minus true, from {:.0f} s after each change of mass on, settled or not: "
              "mean ± standard deviation over seeds. Errors that a robot has from its turn-on on, "
              "such as those of its torque sensors, differ between seeds: they show in the "
              "deviation, not in the mean. Change: against the baseline, seeds in pairs, with "
              "Student's interval; what an error contributes to the bias is the change that "
              "switching it off makes, with the other sign. Noise: standard deviation within an "
              "interval.",
              kLate_s)}};
}

}  // namespace

Section BiasBudgetSection() {
  return {"bias_budget", "Bias budget", WhyNoBiasBudget, BuildBiasBudget};
}

}  // namespace scoria::analysis
