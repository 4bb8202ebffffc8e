// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "analysis/plots/response_plot.h"
#include "analysis/report/metric_table.h"
#include "analysis/report/sections/sections.h"
#include "analysis/report/table.h"
#include "analysis/study/factor_effects.h"

namespace scoria::analysis {
namespace {

/// Metrics that are drawn.
constexpr std::array<std::string_view, 4> kDrawnMetrics = {"falls", "cot_mech_abs",
                                                           "velocity_rmse_mps", "height_rmse_m"};

/// By arm.
std::vector<std::vector<FactorEffects>> AllEffects(const ReportInput& input) {
  std::vector<std::vector<FactorEffects>> all;
  for (const std::string& arm : input.results.arms)
    all.push_back(CalcFactorEffects(input.results, arm, input.metrics));
  return all;
}

ResponseSeries SeriesOf(const Design& design, std::size_t factor, const std::string& arm,
                        const std::vector<FactorEffects>& effects, const MetricInfo& metric) {
  ResponseSeries series{arm, {}, {}};
  for (const FactorEffects& e : effects) {
    if (e.metric.key != metric.key) continue;
    for (std::size_t i = 0; i < design.points.size(); ++i) {
      if (e.responses[i])
        series.points.push_back(
            {std::stod(design.points[i][factor]), metric.scale * *e.responses[i]});
    }
  }
  series.means = BinnedResponse(series.points);
  return series;
}

void AppendFigure(const ReportInput& input, const std::vector<std::vector<FactorEffects>>& all,
                  const MetricInfo& metric, Blocks& blocks) {
  const Design& design = *input.results.design;
  ResponsePlot plot{fmt::format("response_{}", metric.key),
                    fmt::format("Response of {}", metric.title),
                    TitleWithUnit(metric),
                    {}};
  bool any = false;
  for (std::size_t k = 0; k < design.factors.size(); ++k) {
    const Factor& factor = design.factors[k];
    ResponsePanel& panel = plot.panels.emplace_back();
    panel.x_label = factor.label;
    panel.log = factor.scale == FactorScale::kLog;
    for (std::size_t arm = 0; arm < all.size(); ++arm) {
      panel.series.push_back(SeriesOf(design, k, input.results.arms[arm], all[arm], metric));
      any = any || !panel.series.back().points.empty();
    }
  }
  if (!any) return;
  blocks.push_back(
      CaptionedFigure{DrawResponses(plot),
                      "A dot for each point of the design, its seeds averaged, against "
                      "one factor after the other; squares: means of equally many."});
}

std::string IndexText(const SobolIndices& index) {
  if (!std::isfinite(index.total)) return "–";
  const Interval& i = index.total_interval;
  const std::string range =
      std::isfinite(i.low) ? fmt::format(" ({:.2f} to {:.2f})", i.low, i.high) : "";
  return fmt::format("{:.2f}{}, alone {:.2f}", index.total, range, index.first);
}

Table IndexTable(const Design& design, const std::vector<FactorEffects>& effects) {
  Table table{{"metric", "rows"}, {}};
  for (const Factor& factor : design.factors) table.header.push_back(factor.label);
  for (const FactorEffects& e : effects) {
    const auto varies = [](const SobolIndices& i) { return std::isfinite(i.total); };
    if (std::none_of(e.indices.begin(), e.indices.end(), varies)) continue;
    std::vector<std::string>& row = table.rows.emplace_back();
    row = {std::string(e.metric.title), std::to_string(e.rows)};
    for (const SobolIndices& index : e.indices) row.push_back(IndexText(index));
  }
  return table;
}

std::optional<std::string> WhyNoFactors(const ReportInput& input) {
  if (!input.results.design) return "the sweep is no design over factors";
  if (!input.HasMetrics()) return "no episode left numbers";
  return std::nullopt;
}

Blocks BuildFactors(const ReportInput& input) {
  Blocks blocks;
  const std::vector<std::vector<FactorEffects>> all = AllEffects(input);
  for (const std::string_view key : kDrawnMetrics) {
    if (const Metric* metric = FindMetric(input.metrics, key))
      AppendFigure(input, all, metric->info, blocks);
  }
  for (std::size_t arm = 0; arm < all.size(); ++arm) {
    blocks.push_back(Heading{fmt::format("Total effects, {}", input.results.arms[arm])});
    blocks.push_back(IndexTable(*input.results.design, all[arm]));
  }
  blocks.push_back(
      Note{"Share of a metric's variance over the design that a factor explains with all its "
           "interactions (total Sobol index, Jansen's estimator), with its 95 % interval by "
           "resampling rows of points, and alone. Totals add up to more than one where factors "
           "interact, and where seeds differ: what chance makes of a single episode is in every "
           "total. Rows that lack an episode are left out."});
  return blocks;
}

}  // namespace

Section FactorsSection() {
  return {"factors", "Response over the factors", WhyNoFactors, BuildFactors};
}

}  // namespace scoria::analysis
