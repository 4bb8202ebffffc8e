// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/bias_budget.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include <fmt/format.h>

#include "analysis/metrics/model_metrics.h"
#include "analysis/study/compare.h"

namespace scoria::analysis {
namespace {

/// An episode's values: one per interval, or one for all.
struct Late {
  std::vector<double> bias_kg, added_kg, removed_kg, noise_kg, com_x_m, com_y_m;
};
using BySeed = std::map<std::uint64_t, Late>;

double Mean(const std::vector<double>& values) { return EstimateMean(values).mean; }

Late LateOf(const ModelMetrics& model) {
  Late late;
  for (const ModelInterval& i : model.intervals) {
    if (i.late_rows == 0 || i.step_kg == 0.0) continue;
    late.bias_kg.push_back(i.late_bias_kg);
    (i.step_kg > 0.0 ? late.added_kg : late.removed_kg).push_back(i.late_bias_kg);
    late.noise_kg.push_back(i.late_noise_kg);
    late.com_x_m.push_back(i.late_com_x_bias_m);
    late.com_y_m.push_back(i.late_com_y_bias_m);
  }
  return late;
}

BySeed Collect(const CampaignResults& results, const std::string& arm,
               const std::vector<std::string>& point) {
  BySeed seeds;
  for (const EpisodeRecord& e : results.episodes) {
    if (e.arm != arm || e.point != point || !e.metrics.model.present) continue;
    Late late = LateOf(e.metrics.model);
    if (!late.bias_kg.empty()) seeds[e.seed] = std::move(late);
  }
  return seeds;
}

/// Over the seeds that have such intervals, of their means.
MeanEstimate Over(const BySeed& seeds, std::vector<double> Late::*values) {
  std::vector<double> means;
  for (const auto& [seed, late] : seeds) {
    if (!(late.*values).empty()) means.push_back(Mean(late.*values));
  }
  return EstimateMean(means);
}

MeanEstimate Change(const BySeed& seeds, const BySeed& baseline) {
  std::vector<double> differences;
  for (const auto& [seed, late] : seeds) {
    const auto other = baseline.find(seed);
    if (other != baseline.end())
      differences.push_back(Mean(late.bias_kg) - Mean(other->second.bias_kg));
  }
  return EstimateMean(differences);
}

/// "-0.86 ± 0.12"; the mean alone for a single seed.
std::string MeanAndSpread(const MeanEstimate& e, double scale, int digits) {
  if (e.count == 0) return "–";
  const std::string mean = fmt::format("{:+.{}f}", scale * e.mean, digits);
  return e.count == 1 ? mean : fmt::format("{} ± {:.{}f}", mean, scale * e.deviation, digits);
}

}  // namespace

std::vector<BiasLine> CalcBiasBudget(const CampaignResults& results) {
  std::vector<BiasLine> lines;
  const auto axis = std::find_if(results.axes.begin(), results.axes.end(),
                                 [](const Axis& a) { return !a.baseline.empty(); });
  if (axis == results.axes.end()) return lines;
  const auto at = static_cast<std::size_t>(axis - results.axes.begin());
  for (const std::string& arm : results.arms) {
    for (const auto& point : AllPoints(results.axes)) {
      const BySeed seeds = Collect(results, arm, point);
      if (seeds.empty()) continue;
      BiasLine line;
      line.arm = arm;
      line.point = point;
      line.bias_kg = Over(seeds, &Late::bias_kg);
      line.added_kg = Over(seeds, &Late::added_kg);
      line.removed_kg = Over(seeds, &Late::removed_kg);
      line.noise_kg = Over(seeds, &Late::noise_kg);
      line.com_x_m = Over(seeds, &Late::com_x_m);
      line.com_y_m = Over(seeds, &Late::com_y_m);
      line.baseline = point[at] == axis->baseline;
      if (!line.baseline) {
        std::vector<std::string> reference = point;
        reference[at] = axis->baseline;
        line.change_kg = Change(seeds, Collect(results, arm, reference));
      }
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

void AddBiasBudget(const CampaignResults& results, HtmlPage& page) {
  std::vector<std::vector<std::string>> rows;
  for (const BiasLine& line : CalcBiasBudget(results)) {
    std::vector<std::string> row{line.arm};
    row.insert(row.end(), line.point.begin(), line.point.end());
    row.push_back(std::to_string(line.bias_kg.count));
    row.push_back(MeanAndSpread(line.bias_kg, 1.0, 2));
    row.push_back(line.baseline ? "baseline" : FormatDifference(line.change_kg, 1.0, 2));
    row.push_back(MeanAndSpread(line.added_kg, 1.0, 2));
    row.push_back(MeanAndSpread(line.removed_kg, 1.0, 2));
    row.push_back(line.noise_kg.count > 0 ? fmt::format("{:.3f}", line.noise_kg.mean) : "–");
    row.push_back(MeanAndSpread(line.com_x_m, 1e3, 1));
    row.push_back(MeanAndSpread(line.com_y_m, 1e3, 1));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return;
  std::vector<std::string> header{"arm"};
  for (const Axis& axis : results.axes) header.push_back(axis.label);
  for (const char* name : {"seeds", "bias [kg]", "change of the bias [kg]", "after adding [kg]",
                           "after removal [kg]", "noise [kg]", "COM x [mm]", "COM y [mm]"}) {
    header.emplace_back(name);
  }
  page.Heading("Bias budget");
  page.Table(header, rows);
  page.Note(fmt::format(
      "Learned minus true, from {:.0f} s after each change of mass on, settled or not: mean ± "
      "standard deviation over seeds. Errors that a robot has from its turn-on on, such as those "
      "of its torque sensors, differ between seeds: they show in the deviation, not in the mean. "
      "Change: against the baseline, seeds in pairs, with Student's interval; what an error "
      "contributes to the bias is the change that switching it off makes, with the other sign. "
      "Noise: standard deviation within an interval.",
      kLate_s));
}

}  // namespace scoria::analysis
