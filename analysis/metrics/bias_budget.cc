// SPDX-License-Identifier: BSD-3-Clause
#include "analysis/metrics/bias_budget.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "analysis/metrics/model_metrics.h"

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

}  // namespace scoria::analysis
